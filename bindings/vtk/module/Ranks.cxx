// SPDX-License-Identifier: GPL-3.0-or-later
#include "Ranks.h"

#include <vtkCommunicator.h>
#include <vtkMultiProcessController.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

namespace equiaffine {

namespace {

template <class Number>
void reduce(vtkMultiProcessController* controller, std::span<Number> numbers, int operation) {
  if (!controller) return;
  const std::vector<Number> own(numbers.begin(), numbers.end());
  controller->AllReduce(own.data(), numbers.data(), vtkIdType(numbers.size()), operation);
}

} // namespace

Ranks::Ranks(vtkMultiProcessController* controller)
    : controller_(controller && controller->GetNumberOfProcesses() > 1 ? controller : nullptr) {
  if (!controller_) return;
  number_ = controller_->GetLocalProcessId();
  count_ = controller_->GetNumberOfProcesses();
}

void Ranks::check(const std::string& error, bool is_stopped) const {
  std::array<std::int64_t, 2> processes = {error.empty() ? 0 : 1, is_stopped ? 1 : 0}; // failed, stopped
  sum(processes);
  if (!error.empty()) throw Failure(error);
  if (processes[0] > 0) throw Failure("another process has failed; see its error");
  if (processes[1] > 0) throw Stopped_together();
}

void Ranks::sum(std::span<std::int64_t> numbers) const {
  if (!controller_) return;
  std::vector<long long> own(numbers.begin(), numbers.end()), sums(own.size()); // a type that VTK can send
  controller_->AllReduce(own.data(), sums.data(), vtkIdType(own.size()), vtkCommunicator::SUM_OP);
  std::copy(sums.begin(), sums.end(), numbers.begin());
}

void Ranks::least(std::span<double> numbers) const { reduce(controller_, numbers, vtkCommunicator::MIN_OP); }
void Ranks::greatest(std::span<double> numbers) const { reduce(controller_, numbers, vtkCommunicator::MAX_OP); }

void Ranks::add(Volume_survey& survey) const {
  std::array<double, 1> sizes = {survey.greatest};
  greatest(sizes);
  const auto& [constant, lesser, greater] = survey.border_votes;
  std::array<std::int64_t, 4> counts = {survey.are_floats ? 0 : 1, constant, lesser, greater};
  sum(counts);
  survey = {sizes[0], counts[0] == 0, {counts[1], counts[2], counts[3]}};
}

std::vector<double> Ranks::gather(const std::vector<double>& numbers) const {
  const auto own = vtkIdType(numbers.size());
  std::vector<vtkIdType> sizes(std::size_t(count_), own), offsets(std::size_t(count_), 0);
  check("");
  if (!controller_) return numbers;
  controller_->AllGather(&own, sizes.data(), 1);
  std::exclusive_scan(sizes.begin(), sizes.end(), offsets.begin(), vtkIdType(0));
  std::vector<double> all;
  together(*this, [&] { all.resize(std::size_t(offsets.back() + sizes.back())); });
  controller_->AllGatherV(numbers.data(), all.data(), own, sizes.data(), offsets.data());
  return all;
}

} // namespace equiaffine
