#include "worker.h"

#include <gtest/gtest.h>

#include <stdexcept>

using omr::Task;
using omr::Worker;

TEST(Worker, doesOneThingAfterTheOther)
{
  std::vector<int> done;
  Worker worker;
  Task first = worker.begin([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    done.push_back(1);
  });
  Task second = worker.begin([&] { done.push_back(2); });
  second.get();
  EXPECT_EQ((std::vector<int>{1, 2}), done);
  first.get();
}

TEST(Worker, throwsToWhomWaitsAndGoesOn)
{
  Worker worker;
  Task task = worker.begin([] { throw std::runtime_error("no"); });
  EXPECT_THROW(task.get(), std::runtime_error);
  EXPECT_NO_THROW(worker.begin([] {}).get());
}

TEST(Worker, aTaskThatGoesWaitsForItsEnd)
{
  bool is_done = false;
  Worker worker;
  {
    const Task task = worker.begin([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      is_done = true;
    });
  }
  EXPECT_TRUE(is_done);
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
