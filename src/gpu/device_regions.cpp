#include <algorithm>
#include <cstddef>

#include "device_fill.h"

namespace omr
{
/** Strips for a CPU: 16 a core for an even load, 16 to 64 rows each (fewer unions across seams; measured flat there).
 */
Strips DeviceFill::stripsOfDevice() const
{
  Strips strips;
  if (geometry_ == Geometry::strips)
  {
    strips.rows = std::clamp(size_.height / (16 * compute_units_), 16, 64);
    strips.united = true;
  }
  return strips;
}

Groups DeviceFill::strips() const
{
  return {static_cast<std::size_t>(strips_.count(size_.height)), 1};
}

Groups DeviceFill::words(int row_count) const
{
  return program_.groupsOf(static_cast<std::size_t>(divideUp(size_.width, 64)) * row_count);
}

FillMethod DeviceFill::labelRegions(FillMethod method, int sweep_rounds)
{
  if (method == FillMethod::sweep)
  {
    findRuns(Strips());
    if (sweep(sweep_rounds))
    {
      findRegions();
      return FillMethod::sweep;
    }
  }
  findRuns(stripsOfDevice());
  mergeSeams();
  findRegions();
  return FillMethod::runs;
}

void DeviceFill::findRuns(const Strips& strips)
{
  strips_ = strips;
  if (strips_.united)
  {
    launch("runsStrip", this->strips(), *buffers_.mask, size_.width, size_.height, strips_.rows, *buffers_.runs,
           *buffers_.row_first, *buffers_.row_runs, *buffers_.rank, *buffers_.run_slot, *buffers_.parent,
           *buffers_.slot_label, *buffers_.strip_slots);
  }
  else
  {
    launch("runsWord", rows(), *buffers_.mask, size_.width, *buffers_.runs, *buffers_.row_first, *buffers_.row_runs,
           *buffers_.rank, *buffers_.run_slot, *buffers_.parent, *buffers_.slot_label, *buffers_.strip_slots);
  }
}

bool DeviceFill::sweep(int rounds)
{
  sweep_labels_.reserve(context_, size_.area(), sizeof(cl_int));
  launch("sweepInit", rows(), size_.width, *sweep_labels_);
  Counters counters;
  counters.changed = 1;
  for (int round = 0; round < rounds && counters.changed != 0; ++round)
  {
    queue_.enqueueFillBuffer(*buffers_.counters, cl_uint(0), 0, sizeof(Counters));
    launch("sweepRows", program_.groupsOf(size_.height), *buffers_.mask, size_.width, size_.height, *sweep_labels_,
           *buffers_.counters);
    launch("sweepColumns", program_.groupsOf(size_.width), *buffers_.mask, size_.width, size_.height, *sweep_labels_,
           *buffers_.counters);
    queue_.enqueueReadBuffer(*buffers_.counters, CL_TRUE, 0, sizeof(Counters), &counters);
  }
  if (counters.changed != 0)
  {
    return false;
  }
  launch("adoptLabels", rows(), *buffers_.mask, size_.width, *sweep_labels_, *buffers_.runs, *buffers_.row_first,
         *buffers_.row_runs, *buffers_.rank, *buffers_.parent);
  return true;
}

void DeviceFill::mergeSeams()
{
  const int seams = strips_.count(size_.height) - 1;
  if (seams > 0)
  {
    launch("mergeSeams", words(seams), *buffers_.mask, size_.width, size_.height, strips_.rows, *buffers_.row_first,
           *buffers_.rank, *buffers_.run_slot, *buffers_.parent);
  }
}

void DeviceFill::findRegions()
{
  queue_.enqueueFillBuffer(*buffers_.counters, cl_uint(0), 0, sizeof(Counters));
  launch("findRegions", strips(), size_.width, strips_.rows, *buffers_.strip_slots, *buffers_.parent,
         *buffers_.slot_label, cl_int(strips_.united), *buffers_.slot_record, *buffers_.records,
         buffers_.recordCapacity(), *buffers_.counters);
  labelled_ = last_event_;
}

void DeviceFill::sumRegions(const AreaWindow& window, bool measures)
{
  window_ = window;
  measures_ = measures;
  const cl_int with_measures = measures ? 1 : 0;
  if (strips_.united)
  {
    launch("sumStrip", strips(), image_, step_, *buffers_.mask, size_.width, size_.height, strips_.rows, with_measures,
           *buffers_.runs, *buffers_.row_first, *buffers_.row_runs, *buffers_.run_slot, *buffers_.slot_record,
           *buffers_.scratch, *buffers_.records, buffers_.recordCapacity(), *buffers_.counters);
    launch("reduceRecords", strips(), size_.width, strips_.rows, *buffers_.strip_slots, *buffers_.parent,
           *buffers_.slot_record, *buffers_.records, buffers_.recordCapacity(), *buffers_.counters);
  }
  else
  {
    launch("sumWord", words(size_.height), image_, step_, *buffers_.mask, size_.width, size_.height, with_measures,
           *buffers_.runs, *buffers_.row_first, *buffers_.rank, *buffers_.parent, *buffers_.slot_record,
           *buffers_.records, buffers_.recordCapacity(), *buffers_.counters);
  }
  if (measures)
  {
    sumDistances();
  }
  reportRegions();
}

void DeviceFill::sumDistances()
{
  if (strips_.united)
  {
    launch("sumDistancesStrip", strips(), size_.height, strips_.rows, *buffers_.runs, *buffers_.row_first,
           *buffers_.row_runs, *buffers_.run_slot, *buffers_.parent, *buffers_.slot_record, window_.min, window_.max,
           *buffers_.records, buffers_.recordCapacity(), *buffers_.counters);
    launch("reduceDistances", strips(), size_.width, strips_.rows, *buffers_.strip_slots, *buffers_.parent,
           *buffers_.slot_record, *buffers_.records, buffers_.recordCapacity(), *buffers_.counters);
  }
  else
  {
    launch("sumDistancesWord", rows(), *buffers_.runs, *buffers_.row_first, *buffers_.row_runs, *buffers_.parent,
           *buffers_.slot_record, window_.min, window_.max, *buffers_.records, buffers_.recordCapacity(),
           *buffers_.counters);
  }
}

void DeviceFill::reportRegions()
{
  launch("countReports", strips(), size_.width, strips_.rows, *buffers_.strip_slots, *buffers_.parent,
         *buffers_.slot_record, window_.min, window_.max, *buffers_.records, buffers_.recordCapacity(),
         *buffers_.counters, *buffers_.strip_reports);
  launch("reportRegions", strips(), size_.width, strips_.rows, *buffers_.strip_slots, *buffers_.parent,
         *buffers_.slot_record, window_.min, window_.max, *buffers_.records, *buffers_.strip_reports,
         *buffers_.reported, buffers_.reportedCapacity(), *buffers_.counters);
}

int DeviceFill::readSums(std::vector<RegionSums>& sums)
{
  Counters counters;
  giveBack(sums, 2 * std::size_t(buffers_.reportedCapacity()));
  while (true)
  {
    // As many as the last image had arrive together with the counters: one wait for both.
    sums.resize(std::min(expected_reports_, buffers_.reportedCapacity()));
    queue_.enqueueReadBuffer(*buffers_.counters, CL_FALSE, 0, sizeof(Counters), &counters);
    queue_.enqueueReadBuffer(*buffers_.reported, CL_TRUE, 0, sums.size() * sizeof(RegionSums), sums.data());
    if (counters.records > buffers_.recordCapacity())
    {
      buffers_.growRecords(context_, counters.records);
      findRegions();
      sumRegions(window_, measures_);
    }
    else if (counters.reported > buffers_.reportedCapacity())
    {
      buffers_.growReported(context_, counters.reported);
      reportRegions();
    }
    else
    {
      break;
    }
  }
  const std::size_t read = sums.size();
  sums.resize(counters.reported);
  if (counters.reported > read)
  {
    queue_.enqueueReadBuffer(*buffers_.reported, CL_TRUE, read * sizeof(RegionSums),
                             (counters.reported - read) * sizeof(RegionSums), sums.data() + read);
  }
  buffers_.needed(counters, !is_enlargement_);
  expected_reports_ = counters.reported + counters.reported / 4 + 64;
  return static_cast<int>(counters.regions);
}

}  // namespace omr
