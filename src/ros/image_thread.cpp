#include "image_thread.h"

#include <utility>

namespace omr
{
ImageThread::ImageThread(Process process) : process_(std::move(process)), thread_([this] { run(); })
{
}

ImageThread::~ImageThread()
{
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    end_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

bool ImageThread::put(const sensor_msgs::ImageConstPtr& image)
{
  sensor_msgs::ImageConstPtr older = image;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    newest_.swap(older);
  }
  changed_.notify_one();
  return older != nullptr;
}

void ImageThread::run()
{
  std::unique_lock<std::mutex> lock(mutex_);
  while (!end_)
  {
    if (!newest_)
    {
      changed_.wait(lock);
      continue;
    }
    sensor_msgs::ImageConstPtr image;
    image.swap(newest_);
    lock.unlock();
    process_(image);
    image.reset();  // whoever waits for its end need not wait for the next image
    lock.lock();
  }
}

}  // namespace omr
