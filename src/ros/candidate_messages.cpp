#include "candidate_messages.h"

namespace omr
{
namespace
{
sensor_msgs::RegionOfInterest toMessage(const cv::Rect& box)
{
  sensor_msgs::RegionOfInterest message;
  message.x_offset = box.x;
  message.y_offset = box.y;
  message.width = box.width;
  message.height = box.height;
  return message;
}

outdoor_omr::Candidate toMessage(const Candidate& candidate)
{
  outdoor_omr::Candidate message;
  message.kind = candidate.kind == MarkerKind::checkerboard ? outdoor_omr::Candidate::CHECKERBOARD
                                                            : outdoor_omr::Candidate::TARGET;
  message.box = toMessage(candidate.box);
  message.score = candidate.score;
  message.read = candidate.read;
  return message;
}
}  // namespace

outdoor_omr::CandidateArray toMessage(const std_msgs::Header& header, const cv::Size& size,
                                      const std::vector<Candidate>& candidates)
{
  outdoor_omr::CandidateArray message;
  message.header = header;
  message.width = size.width;
  message.height = size.height;
  for (const Candidate& candidate : candidates)
  {
    message.candidates.push_back(toMessage(candidate));
  }
  return message;
}

sensor_msgs::RegionOfInterest unreadRegion(const cv::Size& size, const std::vector<Candidate>& candidates)
{
  cv::Rect region;
  for (const Candidate& candidate : candidates)
  {
    if (!candidate.read)
    {
      const cv::Point margin(candidate.box.width / 2, candidate.box.height / 2);
      region |= cv::Rect(candidate.box.tl() - margin, candidate.box.br() + margin);
    }
  }
  return toMessage(region & cv::Rect({}, size));
}

}  // namespace omr
