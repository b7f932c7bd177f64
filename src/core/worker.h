#ifndef OUTDOOR_OMR_CORE_WORKER_H
#define OUTDOOR_OMR_CORE_WORKER_H

#include <condition_variable>
#include <functional>
#include <future>
#include <mutex>
#include <queue>
#include <thread>
#include <utility>

namespace omr
{
/** What a worker was given to do. Waits for its end when it goes, so that the work may refer to what outlives it. */
class Task
{
 public:
  Task() = default;
  explicit Task(std::future<void> done) : done_(std::move(done))
  {
  }
  Task(Task&&) = default;
  Task& operator=(Task&& other) noexcept
  {
    std::swap(done_, other.done_);
    return *this;
  }
  ~Task()
  {
    if (done_.valid())
    {
      done_.wait();
    }
  }

  /** Waits for the end; throws what the work threw. */
  void get()
  {
    done_.get();
  }

 private:
  std::future<void> done_;
};

/**
 * A thread that does one thing after the other, from image to image: the system takes its time to begin and to end a
 * thread and to find memory for its stack.
 */
class Worker
{
 public:
  Worker();
  ~Worker();

  Task begin(std::function<void()> work);

 private:
  void run();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::queue<std::packaged_task<void()>> waiting_;
  bool end_ = false;
  std::thread thread_;
};

}  // namespace omr

#endif
