// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_BINDINGS_VTK_RANKS_H
#define EQUIAFFINE_BINDINGS_VTK_RANKS_H

#include <equiaffine/volume/Volume_survey.h>

#include <cstdint>
#include <exception>
#include <new>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

class vtkMultiProcessController;

namespace equiaffine {

/// Thrown by all processes if one of them has failed.
struct Failure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Thrown if the user stops this process.
struct Stopped : std::exception {};

/// Thrown by all processes if one of them is stopped.
struct Stopped_together : Stopped {};

/// \throw std::invalid_argument with this sentence unless the condition holds
inline void require(bool condition, const std::string& sentence) {
  if (!condition) throw std::invalid_argument(sentence);
}

/// The processes that work on the pieces of one image. All of them must call the same functions in the same order, even
/// if one of them fails.
class Ranks {
public:
  /// Without a controller there is one process.
  explicit Ranks(vtkMultiProcessController* controller);

  int number() const { return number_; } ///< of this process, from 0
  int count() const { return count_; }   ///< of all processes

  /// Throws a Failure in all processes if one has an error; an empty string means no error. Otherwise throws
  /// Stopped_together in all processes if one is stopped.
  void check(const std::string& error, bool is_stopped = false) const;

  void sum(std::span<std::int64_t> numbers) const; ///< replaces numbers by their sums over all processes
  void least(std::span<double> numbers) const;     ///< replaces numbers by their minima over all processes
  void greatest(std::span<double> numbers) const;  ///< replaces numbers by their maxima over all processes
  void add(Volume_survey& survey) const;           ///< replaces the survey by that of all pieces

  /// The numbers of all processes, ordered by process. Processes can have different amounts of numbers. Calls check().
  std::vector<double> gather(const std::vector<double>& numbers) const;

private:
  vtkMultiProcessController* controller_; // null for one process
  int number_ = 0, count_ = 1;
};

/// Calls work(), then checks in all processes whether one of them has thrown. If work() communicates with other
/// processes, it must call check() before, so that all processes learn of an error of one of them.
template <class Work>
void together(const Ranks& ranks, const Work& work) {
  std::string error;
  bool is_stopped = false;
  try {
    work();
  } catch (const Failure&) {
    throw; // thrown by all processes
  } catch (const Stopped_together&) {
    throw;
  } catch (const Stopped&) {
    is_stopped = true;
  } catch (const std::bad_alloc&) {
    error = "not enough memory; use more processes";
  } catch (const std::exception& e) {
    error = e.what();
  }
  ranks.check(error, is_stopped);
}

} // namespace equiaffine

#endif
