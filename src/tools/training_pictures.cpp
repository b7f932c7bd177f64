#include "training_pictures.h"

#include "clutter_scene.h"

namespace omr
{
TrainingPictures::TrainingPictures(const std::vector<cv::Mat>& photographs, int scenes)
    : photographs_(photographs), scenes_(scenes)
{
}

bool TrainingPictures::all(cv::RNG& /*random*/, WindowLabel /*label*/)
{
  return true;
}

bool TrainingPictures::any(const float* /*features*/, WindowLabel /*label*/)
{
  return true;
}

int TrainingPictures::withMarkers() const
{
  return scenes_;
}

int TrainingPictures::withoutMarkers() const
{
  return static_cast<int>(photographs_.size()) + scenes_ / 2;
}

const cv::Mat& TrainingPictures::anyPhotograph(cv::RNG& random) const
{
  return photographs_[random.uniform(0, static_cast<int>(photographs_.size()))];
}

MarkerScene TrainingPictures::picture(bool with_markers, int i, cv::RNG& random) const
{
  if (with_markers)
  {
    return renderMarkerScene(anyPhotograph(random), random);
  }
  MarkerScene plain;
  const int count = static_cast<int>(photographs_.size());
  plain.image = i < count ? photographs_[i] : renderClutterScene(anyPhotograph(random), random);
  return plain;
}

void TrainingPictures::forEach(bool with_markers, unsigned seed,
                               const std::function<void(int, cv::RNG&, const MarkerScene&)>& call) const
{
  cv::parallel_for_({0, with_markers ? withMarkers() : withoutMarkers()}, [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i)
    {
      cv::RNG random((static_cast<std::uint64_t>(seed) << 32) + i + 1);
      random.next();
      call(i, random, picture(with_markers, i, random));
    }
  });
}

WindowSet TrainingPictures::windows(bool with_markers, unsigned seed, const FeedForward& gate, const Drawn& drawn,
                                    const Wanted& wanted) const
{
  std::vector<WindowSet> parts(with_markers ? withMarkers() : withoutMarkers());
  forEach(with_markers, seed, [&](int i, cv::RNG& random, const MarkerScene& scene) {
    addWindows(
        scene.image, scene.markers, gate, [&](WindowLabel label) { return drawn(random, label); }, wanted, parts[i]);
  });
  WindowSet all;
  for (const WindowSet& part : parts)
  {
    all.append(part);
  }
  return all;
}

}  // namespace omr
