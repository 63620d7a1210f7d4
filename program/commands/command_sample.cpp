// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/commands.h"
#include "source/source.h"
#include "system/atomic_file.h"
#include "volume/volume_io.h"

#include <algorithm>
#include <cmath>

namespace equiaffine {

void run_sample(const Sample_options& options, std::ostream& out, Progress& progress) {
  check_volume_output(options.output);
  Output_file output(options.output);
  const Volume_3<Kernel> volume = sample_source(options.source, progress);
  progress.begin("writing");
  write_volume(output, volume, options.as_float);
  progress.end();
  output.commit();
  const auto [nx, ny, nz] = volume.lattice.size();
  out << nx << " x " << ny << " x " << nz << " nodes";
  const auto unknown =
      std::count_if(volume.values.begin(), volume.values.end(), [](double v) { return std::isnan(v); });
  if (unknown > 0) out << ", " << unknown << " without a value";
  out << '\n';
  report_written(out, {&output, 1});
}

} // namespace equiaffine
