#include "worker.h"

namespace omr
{
Worker::Worker() : thread_([this] { run(); })
{
}

Worker::~Worker()
{
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    end_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

Task Worker::begin(std::function<void()> work)
{
  std::packaged_task<void()> task(std::move(work));
  Task handle(task.get_future());
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    waiting_.push(std::move(task));
  }
  changed_.notify_one();
  return handle;
}

void Worker::run()
{
  std::unique_lock<std::mutex> lock(mutex_);
  while (true)
  {
    changed_.wait(lock, [this] { return end_ || !waiting_.empty(); });
    if (waiting_.empty())
    {
      return;
    }
    std::packaged_task<void()> task = std::move(waiting_.front());
    waiting_.pop();
    lock.unlock();
    task();
    lock.lock();
  }
}

}  // namespace omr
