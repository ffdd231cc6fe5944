#include "host/render/microfacets.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace edgescout {
namespace {

Eigen::Matrix3d surface_frame(const ShadedPoint& surface) {
  Eigen::Vector3d along = surface.grain - surface.grain.dot(surface.normal) * surface.normal;
  if (along.norm() < 1e-3) along = surface.normal.unitOrthogonal();
  Eigen::Matrix3d frame;
  frame.col(0) = along.normalized();
  frame.col(1) = surface.normal.cross(frame.col(0));
  frame.col(2) = surface.normal;
  return frame;
}

}  // namespace

Microfacets::Microfacets(const ShadedPoint& surface, const Material& material)
    : at_normal_(material.reflectance), world_from_surface_(surface_frame(surface)) {
  // Burley, "Physically Based Shading at Disney", 2012.
  const double aspect = std::sqrt(1 - 0.9 * material.anisotropy);
  const double alpha = material.roughness * material.roughness;
  alpha_x_ = alpha * aspect;
  alpha_y_ = alpha / aspect;
  viewer_ = world_from_surface_.transpose() * surface.to_viewer;
  viewer_.z() = std::max(viewer_.z(), 1e-3);
}

// Trowbridge and Reitz, GGX.
double Microfacets::density(const Eigen::Vector3d& facet) const {
  const double x = facet.x() / alpha_x_, y = facet.y() / alpha_y_, z = facet.z();
  const double sum = x * x + y * y + z * z;
  return 1 / (std::numbers::pi * alpha_x_ * alpha_y_ * sum * sum);
}

// Share of the facets that is not hidden from a direction (Smith).
double Microfacets::share_seen(const Eigen::Vector3d& from) const {
  const double x = alpha_x_ * from.x(), y = alpha_y_ * from.y(), z = from.z();
  return 2 / (1 + std::sqrt(1 + (x * x + y * y) / (z * z)));
}

// Schlick's approximation of Fresnel's equations.
double Microfacets::reflectance(double cosine) const {
  return at_normal_ + (1 - at_normal_) * std::pow(1 - cosine, 5);
}

// Heitz, "Sampling the GGX Distribution of Visible Normals", JCGT 2018.
Eigen::Vector3d Microfacets::visible_facet(double u, double v) const {
  const Eigen::Vector3d stretched =
      Eigen::Vector3d(alpha_x_ * viewer_.x(), alpha_y_ * viewer_.y(), viewer_.z()).normalized();
  const double level = stretched.head<2>().norm();
  const Eigen::Vector3d t1 = level > 0
                                 ? Eigen::Vector3d(-stretched.y() / level, stretched.x() / level, 0)
                                 : Eigen::Vector3d(1, 0, 0);
  const Eigen::Vector3d t2 = stretched.cross(t1);
  const double r = std::sqrt(u), a = r * std::cos(2 * std::numbers::pi * v),
               s = 0.5 * (1 + stretched.z());
  const double b = (1 - s) * std::sqrt(1 - a * a) + s * r * std::sin(2 * std::numbers::pi * v);
  const Eigen::Vector3d facet =
      a * t1 + b * t2 + std::sqrt(std::max(0.0, 1 - a * a - b * b)) * stretched;
  return Eigen::Vector3d(alpha_x_ * facet.x(), alpha_y_ * facet.y(), std::max(0.0, facet.z()))
      .normalized();
}

FacetSample Microfacets::sample(double u, double v) const {
  const Eigen::Vector3d facet = visible_facet(u, v);
  const double cosine = std::clamp(viewer_.dot(facet), 0.0, 1.0);
  const Eigen::Vector3d mirrored = 2 * cosine * facet - viewer_;
  FacetSample sample;
  sample.direction = (world_from_surface_ * mirrored).normalized();
  if (mirrored.z() <= 0) return sample;
  sample.weight = reflectance(cosine) * share_seen(mirrored);
  sample.density = share_seen(viewer_) * density(facet) / (4 * viewer_.z());
  return sample;
}

double Microfacets::highlight(const Eigen::Vector3d& to_light) const {
  const Eigen::Vector3d light = world_from_surface_.transpose() * to_light;
  if (light.z() <= 0) return 0;
  const Eigen::Vector3d facet = (light + viewer_).normalized();
  return std::numbers::pi * reflectance(std::clamp(viewer_.dot(facet), 0.0, 1.0)) * density(facet) *
         share_seen(viewer_) * share_seen(light) / (4 * viewer_.z() * light.z());
}

}  // namespace edgescout
