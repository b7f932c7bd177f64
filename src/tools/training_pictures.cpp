#include "training_pictures.h"

#include "clutter_scene.h"

namespace omr
{
TrainingPictures::TrainingPictures(const std::vector<cv::Mat>& photographs, int scenes)
    : photographs_(photographs), scenes_(scenes)
{
}

int TrainingPictures::withMarkers() const
{
  return scenes_;
}

int TrainingPictures::withoutMarkers() const
{
  return static_cast<int>(photographs_.size()) + scenes_ / 2;
}

const cv::Mat& TrainingPictures::any(cv::RNG& random) const
{
  return photographs_[random.uniform(0, static_cast<int>(photographs_.size()))];
}

MarkerScene TrainingPictures::picture(bool with_markers, int i, cv::RNG& random) const
{
  if (with_markers)
  {
    return renderMarkerScene(any(random), random);
  }
  MarkerScene plain;
  const int count = static_cast<int>(photographs_.size());
  plain.image = i < count ? photographs_[i] : renderClutterScene(any(random), random);
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

WindowSet TrainingPictures::windows(bool with_markers, unsigned seed, const FeedForward& gate,
                                    const Wanted& wanted) const
{
  std::vector<WindowSet> parts(with_markers ? withMarkers() : withoutMarkers());
  forEach(with_markers, seed, [&](int i, cv::RNG& random, const MarkerScene& scene) {
    addWindows(
        scene.image, scene.markers, gate,
        [&](const float* features, WindowLabel label) { return wanted(random, features, label); }, parts[i]);
  });
  WindowSet all;
  for (const WindowSet& part : parts)
  {
    all.append(part);
  }
  return all;
}

}  // namespace omr
