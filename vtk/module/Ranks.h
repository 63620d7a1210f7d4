// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VTK_RANKS_H
#define EQUIAFFINE_VTK_RANKS_H

#include <equiaffine/volume/Volume_survey.h>

#include <cstdint>
#include <new>
#include <span>
#include <stdexcept>
#include <string>

class vtkMultiProcessController;

namespace equiaffine {

/// Is thrown by all processes where one of them has failed.
struct Failure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// \throw std::invalid_argument with a sentence unless a condition holds
inline void require(bool condition, const std::string& sentence) {
  if (!condition) throw std::invalid_argument(sentence);
}

/// The processes that work on the pieces of one image. All of them call the same functions in the same order, whatever
/// happens to one of them.
class Ranks {
public:
  /// Without a controller there is one process.
  explicit Ranks(vtkMultiProcessController* controller);

  int number() const { return number_; } ///< of this process, from 0
  int count() const { return count_; }   ///< of all processes

  /// Throws a Failure in all processes if one has an error, which is a sentence, or empty if there is none.
  void check(const std::string& error) const;

  void sum(std::span<std::int64_t> numbers) const; ///< replaces numbers by their sums over all processes
  void least(std::span<double> numbers) const;     ///< by the least ones
  void greatest(std::span<double> numbers) const;  ///< by the greatest ones
  void add(Volume_survey& survey) const;           ///< by the survey of all pieces

private:
  vtkMultiProcessController* controller_; // null for one process
  int number_ = 0, count_ = 1;
};

/// Calls work() and checks in all processes whether one of them has thrown.
template <class Work>
void together(const Ranks& ranks, const Work& work) {
  std::string error;
  try {
    work();
  } catch (const std::bad_alloc&) {
    error = "there is not enough memory; use more processes";
  } catch (const std::exception& e) {
    error = e.what();
  }
  ranks.check(error);
}

} // namespace equiaffine

#endif
