#include "diagnostics.h"

namespace omr
{
namespace
{
using diagnostic_msgs::DiagnosticStatus;

constexpr double PATIENCE = 5.0;  // [s] without an image before a warning: no camera runs at less than 0.2 Hz

double secondsBetween(std::chrono::steady_clock::time_point start, std::chrono::steady_clock::time_point end)
{
  return std::chrono::duration<double>(end - start).count();
}
}  // namespace

Diagnostics::Diagnostics(const ros::NodeHandle& nh, const ros::NodeHandle& private_nh, const std::string& name,
                         const FillPipeline& pipeline)
    : device_(pipeline.device()),
      last_report_(Clock::now()),
      report_(nh, private_nh, name, "marker detection", device_.name, [this](auto& status) { report(status); })
{
}

void Diagnostics::subscribed(const std::string& topic)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  topic_ = topic;
  no_subscription_.clear();
  last_image_ = Clock::now();
}

void Diagnostics::notSubscribed(const std::string& reason)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  no_subscription_ = reason;
}

void Diagnostics::dropped()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  ++dropped_;
}

void Diagnostics::processed(const std::vector<StepTime>& times)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  ++processed_;
  times_ = times;
  last_image_ = Clock::now();
}

void Diagnostics::ranOn(const DeviceState& device)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  device_ = device;
}

void Diagnostics::refused(const std::string& reason)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  ++refused_;
  refusal_ = reason;
  last_image_ = Clock::now();
}

void Diagnostics::report(diagnostic_updater::DiagnosticStatusWrapper& status)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  const Clock::time_point now = Clock::now();
  rate_ = static_cast<double>(processed_ - processed_reported_) / secondsBetween(last_report_, now);
  summarize(status);
  last_report_ = now;
  processed_reported_ = processed_;
  refused_reported_ = refused_;
  failures_reported_ = device_.failures;

  status.add("Device", device_.name);
  status.add("Fallback reason", device_.fallback_reason);
  status.add("Device failures", device_.failures);
  status.add("Last device failure", device_.last_failure);
  status.add("Image topic", topic_);
  status.add("Images processed", processed_);
  status.add("Images dropped", dropped_);
  status.add("Images refused", refused_);
  status.add("Last refusal", refusal_);
  status.addf("Images per second", "%.1f", rate_);
  double total = 0;
  for (const StepTime& time : times_)
  {
    status.addf("Time of " + time.step + " [ms]", "%.2f", time.milliseconds);
    total += time.milliseconds;
  }
  status.addf("Time of all steps [ms]", "%.2f", total);
}

void Diagnostics::summarize(diagnostic_updater::DiagnosticStatusWrapper& status) const
{
  const double silence = secondsBetween(last_image_, Clock::now());
  if (!no_subscription_.empty())
  {
    status.summaryf(DiagnosticStatus::ERROR, "Cannot subscribe to the images: %s", no_subscription_.c_str());
  }
  else if (!topic_.empty() && silence > PATIENCE)
  {
    status.summaryf(DiagnosticStatus::WARN, "No image on %s for %.0f s.", topic_.c_str(), silence);
  }
  else if (device_.failures > failures_reported_)
  {
    const auto level = refused_ > refused_reported_ ? DiagnosticStatus::ERROR : DiagnosticStatus::WARN;
    status.summaryf(level, "The device failed: %s.", device_.last_failure.c_str());
  }
  else if (refused_ > refused_reported_)
  {
    status.summaryf(DiagnosticStatus::WARN, "Images refused: %s.", refusal_.c_str());
  }
  else if (!device_.fallback_reason.empty())
  {
    status.summaryf(DiagnosticStatus::WARN, "Running on %s: %s", device_.name.c_str(), device_.fallback_reason.c_str());
  }
  else if (topic_.empty())
  {
    status.summary(DiagnosticStatus::OK, "Idle: nobody listens.");
  }
  else
  {
    status.summaryf(DiagnosticStatus::OK, "%.1f images processed per second.", rate_);
  }
}

}  // namespace omr
