// SPDX-License-Identifier: GPL-3.0-or-later
#include "Ranks.h"

#include <vtkCommunicator.h>
#include <vtkMultiProcessController.h>

#include <algorithm>
#include <array>
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

void Ranks::check(const std::string& error) const {
  std::array<std::int64_t, 1> failed = {error.empty() ? 0 : 1};
  sum(failed);
  if (!error.empty()) throw Failure(error);
  if (failed[0] > 0) throw Failure("another process has failed; its error says why");
}

void Ranks::sum(std::span<std::int64_t> numbers) const {
  if (!controller_) return;
  std::vector<long long> own(numbers.begin(), numbers.end()), sums(own.size()); // a type that VTK sends
  controller_->AllReduce(own.data(), sums.data(), vtkIdType(own.size()), vtkCommunicator::SUM_OP);
  std::copy(sums.begin(), sums.end(), numbers.begin());
}

void Ranks::least(std::span<double> numbers) const { reduce(controller_, numbers, vtkCommunicator::MIN_OP); }
void Ranks::greatest(std::span<double> numbers) const { reduce(controller_, numbers, vtkCommunicator::MAX_OP); }

void Ranks::add(Volume_survey& survey) const {
  std::array<double, 1> sizes = {survey.greatest};
  greatest(sizes);
  std::array<std::int64_t, 2> counts = {survey.border_votes, survey.are_floats ? 0 : 1};
  sum(counts);
  survey = {sizes[0], counts[1] == 0, counts[0]};
}

} // namespace equiaffine
