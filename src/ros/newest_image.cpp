#include "newest_image.h"

#include <boost/make_shared.hpp>
#include <utility>

namespace outdoor_omr
{
namespace
{
class Call : public ros::CallbackInterface
{
 public:
  explicit Call(std::function<void()> function) : function_(std::move(function))
  {
  }

  CallResult call() override
  {
    function_();
    return Success;
  }

 private:
  std::function<void()> function_;
};
}  // namespace

bool NewestImage::put(const sensor_msgs::ImageConstPtr& image)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  const bool waiting = image_ != nullptr;
  image_ = image;
  return waiting;
}

sensor_msgs::ImageConstPtr NewestImage::take()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(image_, nullptr);
}

void callLater(ros::CallbackQueueInterface& queue, const std::function<void()>& function)
{
  queue.addCallback(boost::make_shared<Call>(function));
}

}  // namespace outdoor_omr
