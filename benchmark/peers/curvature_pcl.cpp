// SPDX-License-Identifier: GPL-3.0-or-later
#include "curvature_peers.h"

#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <pcl/surface/impl/mls.hpp> // the inline functions of MLSResult
#include <pcl/surface/mls.h>

Euclidean_curvatures moving_least_squares(const Plain_mesh& mesh, double radius, int degree) {
  const pcl::PointCloud<pcl::PointXYZ>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZ>);
  for (const auto& [x, y, z] : mesh.points) cloud->emplace_back(float(x), float(y), float(z));
  pcl::MovingLeastSquares<pcl::PointXYZ, pcl::PointNormal> fits;
  fits.setInputCloud(cloud);
  fits.setSearchMethod(pcl::search::KdTree<pcl::PointXYZ>::Ptr(new pcl::search::KdTree<pcl::PointXYZ>));
  fits.setSearchRadius(radius);
  fits.setPolynomialOrder(degree);
  fits.setCacheMLSResults(true);
  pcl::PointCloud<pcl::PointNormal> moved;
  fits.process(moved);
  Euclidean_curvatures result;
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    const auto& fit = fits.getMLSResults()[i];
    double u = 0, v = 0;
    fit.getMLSCoordinates(cloud->at(i).getVector3fMap().cast<double>(), u, v);
    const Eigen::Vector2f curvatures = fit.calculatePrincipalCurvatures(u, v);
    result.mean.push_back(0.5 * double(curvatures[0] + curvatures[1]));
    result.gaussian.push_back(double(curvatures[0]) * double(curvatures[1]));
  }
  return result;
}
