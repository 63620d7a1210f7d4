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

/// Is thrown by all processes where one of them has failed.
struct Failure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Is thrown where the user ends the work of this process.
struct Stopped : std::exception {};

/// Is thrown by all processes where one of them is stopped.
struct Stopped_together : Stopped {};

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

  /// Throws a Failure in all processes if one has an error, which is a sentence, or empty if there is none. Else throws
  /// Stopped_together in all if one is stopped.
  void check(const std::string& error, bool is_stopped = false) const;

  void sum(std::span<std::int64_t> numbers) const; ///< replaces numbers by their sums over all processes
  void least(std::span<double> numbers) const;     ///< by the least ones
  void greatest(std::span<double> numbers) const;  ///< by the greatest ones
  void add(Volume_survey& survey) const;           ///< by the survey of all pieces

  /// The numbers of all processes, in the order of the processes. Each may have another number of them. Checks whether
  /// all processes came here.
  std::vector<double> gather(const std::vector<double>& numbers) const;

private:
  vtkMultiProcessController* controller_; // null for one process
  int number_ = 0, count_ = 1;
};

/// Calls work() and checks in all processes whether one of them has thrown. Where work() has the processes tell each
/// other anything, a check must come first, so that they learn of an error of one of them.
template <class Work>
void together(const Ranks& ranks, const Work& work) {
  std::string error;
  bool is_stopped = false;
  try {
    work();
  } catch (const Failure&) {
    throw; // by all processes
  } catch (const Stopped_together&) {
    throw;
  } catch (const Stopped&) {
    is_stopped = true;
  } catch (const std::bad_alloc&) {
    error = "there is not enough memory; use more processes";
  } catch (const std::exception& e) {
    error = e.what();
  }
  ranks.check(error, is_stopped);
}

} // namespace equiaffine

#endif
