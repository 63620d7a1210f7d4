// SPDX-License-Identifier: GPL-3.0-or-later
#include "spline_peers.h"

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <teem/gage.h>

namespace {

void check(bool has_failed) {
  if (!has_failed) return;
  char* message = biffGetDone(GAGE);
  std::fprintf(stderr, "gage: %s\n", message);
  std::exit(1);
}

} // namespace

Spline_evaluation gage_spline(const std::vector<double>& samples, std::size_t n) {
  const auto data = std::make_shared<std::vector<double>>(samples);
  Nrrd* const nrrd = nrrdNew();
  nrrdWrap_va(nrrd, data->data(), nrrdTypeDouble, 3, n, n, n);
  nrrdAxisInfoSet_va(nrrd, nrrdAxisInfoSpacing, 1.0, 1.0, 1.0);
  nrrdAxisInfoSet_va(nrrd, nrrdAxisInfoCenter, nrrdCenterNode, nrrdCenterNode, nrrdCenterNode);
  gageContext* const context = gageContextNew();
  gageParmSet(context, gageParmCheckIntegrals, AIR_FALSE);
  gagePerVolume* const volume = gagePerVolumeNew(context, nrrd, gageKindScl);
  check(!volume || gagePerVolumeAttach(context, volume));
  const double parameters[NRRD_KERNEL_PARMS_NUM] = {1.0};
  check(gageKernelSet(context, gageKernel00, nrrdKernelBSpline5, parameters) ||
        gageKernelSet(context, gageKernel11, nrrdKernelBSpline5D, parameters) ||
        gageKernelSet(context, gageKernel22, nrrdKernelBSpline5DD, parameters) ||
        gageQueryItemOn(context, volume, gageSclValue) || gageQueryItemOn(context, volume, gageSclGradVec) ||
        gageQueryItemOn(context, volume, gageSclHessian) || gageUpdate(context));
  const double* const value = gageAnswerPointer(context, volume, gageSclValue);
  const double* const gradient = gageAnswerPointer(context, volume, gageSclGradVec);
  const double* const hessian = gageAnswerPointer(context, volume, gageSclHessian);
  return [=](const Lattice_points& points) { // data lives as long as this
    double sum = data->front();
    for (const auto& [x, y, z] : points) {
      gageProbe(context, x, y, z);
      sum += *value + gradient[0] + gradient[1] + gradient[2];
      for (int i = 0; i < 9; ++i) sum += hessian[i];
    }
    return sum;
  };
}
