// SPDX-License-Identifier: GPL-3.0-or-later
#include "spline_peers.h"

#include <itkBSplineInterpolateImageFunction.h>
#include <itkImage.h>

#include <algorithm>

Spline_evaluation itk_spline(const std::vector<double>& samples, std::size_t n) {
  using Image = itk::Image<double, 3>;
  const auto image = Image::New();
  Image::SizeType size;
  size.Fill(n);
  image->SetRegions(size);
  image->Allocate();
  std::copy(samples.begin(), samples.end(), image->GetBufferPointer());
  using Spline = itk::BSplineInterpolateImageFunction<Image, double, double>;
  const auto spline = Spline::New();
  spline->SetSplineOrder(5);
  spline->SetInputImage(image);
  return [spline](const Lattice_points& points) {
    double sum = 0;
    for (const auto& [x, y, z] : points) {
      Spline::ContinuousIndexType index;
      index[0] = x;
      index[1] = y;
      index[2] = z;
      Spline::OutputType value;
      Spline::CovariantVectorType gradient;
      spline->EvaluateValueAndDerivativeAtContinuousIndex(index, value, gradient);
      sum += value + gradient[0] + gradient[1] + gradient[2];
    }
    return sum;
  };
}
