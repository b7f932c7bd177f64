#include "outdoor_omr/candidates.h"

#include <gtest/gtest.h>

#include <cmath>

#include "outdoor_omr/window_scores.h"

using omr::Candidate;
using omr::MarkerKind;
using omr::MarkerScores;

namespace
{
const cv::Size SIZE(320, 240);

/** Scores of an image in which some windows show a marker. */
class Scores
{
 public:
  Scores() : scores_(omr::windowCount(SIZE), MarkerScores{-1, -1})
  {
  }

  /** A block of windows. @param first column and row. */
  void show(MarkerKind kind, int level, const cv::Rect& windows, float score)
  {
    int start = 0;
    for (int below = 0; below < level; ++below)
    {
      start += omr::windowGrid(SIZE, below).area();
    }
    for (int y = windows.y; y < windows.br().y; ++y)
    {
      for (int x = windows.x; x < windows.br().x; ++x)
      {
        scores_[start + y * omr::windowGrid(SIZE, level).width + x][static_cast<int>(kind)] = score;
      }
    }
  }

  std::vector<Candidate> candidates() const
  {
    omr::MarkerNetwork network;
    network.thresholds = {.5F, .5F};
    return candidates(network);
  }

  std::vector<Candidate> candidates(const omr::MarkerNetwork& network) const
  {
    return omr::findCandidates(SIZE, scores_, network);
  }

 private:
  std::vector<MarkerScores> scores_;
};

omr::Checkerboard boardAt(const cv::Rect2f& box)
{
  omr::Checkerboard board;
  board.corners = {box.tl(), cv::Point2f(box.br().x, box.y), box.br(), cv::Point2f(box.x, box.br().y)};
  return board;
}
}  // namespace

TEST(Candidates, noWindowAboveTheThresholdGivesNone)
{
  Scores scores;
  scores.show(MarkerKind::checkerboard, 0, {3, 3, 6, 6}, .49F);
  EXPECT_TRUE(scores.candidates().empty());
}

TEST(Candidates, theEvidenceIsThatOfTheWindows)
{
  Scores scores;
  scores.show(MarkerKind::target, 0, {10, 5, 4, 3}, .8F);
  scores.show(MarkerKind::target, 0, {11, 6, 2, 1}, -1.F);
  omr::MarkerNetwork network;
  network.thresholds = {.5F, .5F};
  network.boxes[0].weights = {100, 100, 100, 100};
  network.boxes[1].weights = {-1, 2, 3, 4};
  const std::vector<Candidate> found = scores.candidates(network);
  ASSERT_EQ(1U, found.size());
  const std::array<float, omr::BOX_FEATURES> features = omr::boxFeatures(found[0]);
  EXPECT_FLOAT_EQ(std::atanh(.8F), features[0]);
  EXPECT_FLOAT_EQ(std::log2(10.F), features[1]);
  EXPECT_FLOAT_EQ(std::log2(10.F / 12), features[2]);
  EXPECT_FLOAT_EQ(-1 + 2 * features[0] + 3 * features[1] + 4 * features[2], found[0].evidence);
}

TEST(Candidates, aCertainScoreHasFiniteEvidence)
{
  Scores scores;
  scores.show(MarkerKind::checkerboard, 0, {10, 5, 1, 1}, 1.F);
  ASSERT_EQ(1U, scores.candidates().size());
  EXPECT_LT(omr::boxFeatures(scores.candidates()[0])[0], 5);
}

TEST(Candidates, thoseInDoubtStayOnlyIfTheyWereRead)
{
  omr::MarkerNetwork network;
  network.boxes[0] = {{}, 1, 2};
  network.boxes[1] = {{}, 3, 4};
  std::vector<Candidate> candidates(4);
  candidates[0].evidence = 2;
  candidates[1].evidence = 1.9F;
  candidates[2].evidence = -9;
  candidates[2].read = true;
  candidates[3].evidence = 2;
  candidates[3].kind = MarkerKind::target;
  omr::removeDoubtful(network, &omr::BoxEvidence::enlarged, candidates);
  EXPECT_EQ(3U, candidates.size());
  omr::removeDoubtful(network, &omr::BoxEvidence::shown, candidates);
  ASSERT_EQ(2U, candidates.size());
  EXPECT_EQ(2, candidates[0].evidence);
  EXPECT_TRUE(candidates[1].read);
}

TEST(Candidates, neighbouringWindowsMakeOneBox)
{
  Scores scores;
  scores.show(MarkerKind::checkerboard, 0, {10, 5, 4, 3}, .8F);
  scores.show(MarkerKind::checkerboard, 0, {15, 5, 1, 3}, .9F);  // one column is missed between them
  const std::vector<Candidate> found = scores.candidates();
  ASSERT_EQ(1U, found.size());
  EXPECT_EQ(cv::Rect(40, 20, 36, 24), found[0].box);
  EXPECT_FLOAT_EQ(.9F, found[0].score);
  EXPECT_EQ(15, found[0].windows);
  EXPECT_EQ(2, found[0].cell);
  EXPECT_EQ(MarkerKind::checkerboard, found[0].kind);
  EXPECT_FALSE(found[0].read);
}

TEST(Candidates, placesApartAreTwoTheBetterSupportedFirst)
{
  Scores scores;
  scores.show(MarkerKind::target, 0, {2, 2, 2, 2}, .95F);
  scores.show(MarkerKind::checkerboard, 1, {20, 10, 4, 4}, .95F);
  const std::vector<Candidate> found = scores.candidates();
  ASSERT_EQ(2U, found.size());
  EXPECT_EQ(MarkerKind::checkerboard, found[0].kind);
  EXPECT_EQ(MarkerKind::target, found[1].kind);
}

TEST(Candidates, inOnePlaceTheBetterSupportedKindStays)
{
  Scores scores;
  scores.show(MarkerKind::checkerboard, 0, {10, 10, 6, 6}, .95F);
  scores.show(MarkerKind::target, 0, {11, 11, 2, 2}, .9F);
  const std::vector<Candidate> found = scores.candidates();
  ASSERT_EQ(1U, found.size());
  EXPECT_EQ(MarkerKind::checkerboard, found[0].kind);
}

TEST(Candidates, levelsThatSeeTheSameAreOne)
{
  Scores scores;
  scores.show(MarkerKind::checkerboard, 0, {10, 10, 6, 6}, .95F);
  scores.show(MarkerKind::checkerboard, 1, {4, 4, 3, 3}, .7F);
  const std::vector<Candidate> found = scores.candidates();
  ASSERT_EQ(1U, found.size());
  EXPECT_EQ(cv::Rect(32, 32, 48, 48), found[0].box);
  EXPECT_EQ(45, found[0].windows);
}

TEST(Candidates, anImageWithoutWindowsHasNone)
{
  EXPECT_TRUE(omr::findCandidates({12, 12}, {}, omr::MarkerNetwork()).empty());
}

TEST(Candidates, aMarkerInItsPlaceReadsACandidate)
{
  std::vector<Candidate> candidates(3);
  candidates[0].box = {100, 100, 50, 40};
  candidates[1].box = {200, 100, 50, 40};
  candidates[2].box = {20, 150, 40, 40};
  omr::Target target;
  target.rings.emplace_back(cv::Point2f(40, 170), cv::Size2f(60, 60), 0);
  omr::markRead({320, 240}, {boardAt({104, 98, 44, 40}), boardAt({240, 130, 60, 60})}, {target}, candidates);
  EXPECT_TRUE(candidates[0].read);
  EXPECT_FALSE(candidates[1].read) << "only a corner of it is covered";
  EXPECT_TRUE(candidates[2].read);
}

TEST(Candidates, everyMarkerThatIsReadIsCoveredByOne)
{
  std::vector<Candidate> candidates(2);
  candidates[0].box = {100, 100, 40, 40};  // parts of the board
  candidates[1].box = {150, 100, 40, 40};
  omr::Target target;
  target.rings.emplace_back(cv::Point2f(40, 170), cv::Size2f(60, 60), 0);
  const cv::Rect board(95, 90, 120, 80);
  omr::markRead({320, 240}, {boardAt(board)}, {target}, candidates);
  ASSERT_EQ(3U, candidates.size());
  EXPECT_GE((candidates[0].box & board).area(), .98 * board.area());
  EXPECT_EQ(cv::Rect(150, 100, 40, 40), candidates[1].box) << "once is enough";
  EXPECT_TRUE(candidates[1].read);
  EXPECT_TRUE(candidates[2].read);
  EXPECT_EQ(MarkerKind::target, candidates[2].kind);
  EXPECT_TRUE(candidates[2].box.contains({12, 142}));
  omr::markRead({320, 240}, {boardAt(board)}, {target}, candidates);
  EXPECT_EQ(3U, candidates.size());
}

TEST(Candidates, thoseOfMarkersThatThePictureCutsEndWithIt)
{
  std::vector<Candidate> candidates;
  omr::Target target;
  target.rings.emplace_back(cv::Point2f(10, 100), cv::Size2f(60, 60), 0);
  omr::markRead({320, 240}, {boardAt({280, 200, 100, 80})}, {target}, candidates);
  ASSERT_EQ(2U, candidates.size());
  for (const Candidate& candidate : candidates)
  {
    EXPECT_FALSE(candidate.box.empty());
    EXPECT_EQ(candidate.box, candidate.box & cv::Rect(0, 0, 320, 240));
  }
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
