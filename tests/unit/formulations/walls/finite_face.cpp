// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/walls/finite_face.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/test/unit_test.hpp>

#include "formulations/kernels/kernel.hpp"
#include "tests/support/dense.hpp"
#include "tests/support/kernels.hpp"

BOOST_AUTO_TEST_SUITE(formulations_walls_finite_face)

using namespace sphverify;
using namespace sphverify::tests;
using boost::test_tools::tolerance;
using std::numbers::pi;

/// Every kernel, with smoothing lengths of it that have the supports of the cubic spline's.
template <int Dim>
std::vector<Kernel const*> all_kernels() {
  std::vector<Kernel const*> all;
  for (KernelInfo const& info : all_kernel_infos()) all.push_back(&kernel(info.id, Dim));
  return all;
}
double of_same_support(double h, Kernel const& W) { return 2.0 * h / W.support_ratio(); }

using MoreDimensions = std::tuple<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

/// A line (in 2D a point) that bounds a plane figure: inside, r . normal < distance, with r from a centre.
template <int Dim>
struct Bound {
  Vector<Dim> normal;
  double distance;
};

/// Angle of the circle of radius s that lies within all bounds, by merging the arcs beyond each.
double open_angle(std::vector<Bound<3>> const& bounds, Vector<3> const& u, double s) {
  Vector<3> const first = u.unitOrthogonal();
  Vector<3> const second = u.cross(first);
  std::vector<std::pair<double, double>> closed;
  for (auto const& [normal, distance] : bounds) {
    if (distance >= s) continue;
    if (distance <= -s) return 0.0;
    double const half = std::acos(distance / s);
    double from = std::atan2(normal.dot(second), normal.dot(first)) - half;
    if (from < 0.0) from += 2.0 * pi;
    closed.emplace_back(from, std::min(from + 2.0 * half, 2.0 * pi));
    if (from + 2.0 * half > 2.0 * pi) closed.emplace_back(0.0, from + 2.0 * half - 2.0 * pi);
  }
  std::sort(closed.begin(), closed.end());
  double open = 0.0, end = 0.0;
  for (auto const& [from, to] : closed) {
    if (from > end) open += from - end;
    end = std::max(end, to);
  }
  return open + std::max(0.0, 2.0 * pi - end);
}

/// Integral of f(distance to x) over the part of the plane (x + z u, normal u) that lies inside the walls but
/// `own`, in rings around x + z u that adaptive quadrature adds up.
template <int Dim, class Function>
double slice(Vector<Dim> const& x, Vector<Dim> const& u, double z, std::vector<Wall<Dim>> const& walls,
             double h, Kernel const& W, Function const& f, std::size_t own = 99) {
  double const support = W.support_ratio() * h;
  if (std::abs(z) >= support) return 0.0;
  double const edge = std::sqrt((support - z) * (support + z));
  std::vector<Bound<Dim>> bounds;
  std::vector<double> ends{0.0, edge};
  for (double const knot : W.knots()) ends.push_back(written::half_chord(knot * h, std::abs(z)));
  for (std::size_t w = 0; w < walls.size(); ++w) {
    if (w == own) continue;
    Vector<Dim> const along = walls[w].outward_normal - u.dot(walls[w].outward_normal) * u;
    double const gap = walls[w].distance(x + z * u);
    if (along.norm() < 1e-10) {
      if (gap < 0.0) return 0.0;
      continue;
    }
    bounds.push_back({along.normalized(), gap / along.norm()});
    ends.push_back(std::abs(bounds.back().distance));
  }
  for (std::size_t a = 0; a < bounds.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {  // where two lines meet
      double const cosine = bounds[a].normal.dot(bounds[b].normal);
      double const da = bounds[a].distance, db = bounds[b].distance;
      ends.push_back(std::sqrt(std::max(0.0, da * da + db * db - 2.0 * da * db * cosine) /
                               std::max(1e-300, 1.0 - cosine * cosine)));
    }
  }
  std::sort(ends.begin(), ends.end());
  double sum = 0.0;
  for (std::size_t k = 0; k + 1 < ends.size() && ends[k] < edge; ++k) {
    sum += quadrature(
        [&](double s) {
          double visible = 0.0;
          if constexpr (Dim == 2) {
            for (double const sign : {-1.0, 1.0}) {
              Vector<2> const r = sign * s * Vector<2>(-u[1], u[0]);
              bool const in = std::all_of(bounds.begin(), bounds.end(), [&](Bound<2> const& bound) {
                return r.dot(bound.normal) < bound.distance;
              });
              visible += in ? 1.0 : 0.0;
            }
          } else {
            visible = s * open_angle(bounds, u, s);
          }
          return visible * f(std::hypot(z, s));
        },
        ends[k], std::min(edge, ends[k + 1]));
  }
  return sum;
}

/// Face weight of a wall by rings.
template <int Dim>
double brute_weight(Vector<Dim> const& x, std::vector<Wall<Dim>> const& walls, std::size_t index, double h,
                    FaceWeight rule, Kernel const& W) {
  Vector<Dim> const n = walls[index].outward_normal;
  double const d = walls[index].distance(x);
  auto const value = [&](double r) { return written::kernel(W.id(), Dim, r, h); };
  if (rule == FaceWeight::exact) return slice(x, n, d, walls, h, W, value, index);
  return value(d) * slice(
                        x, n, d, walls, h, W, [](double) { return 1.0; }, index);
}

/// Adaptive quadrature to a looser tolerance, for nesting.
template <class Function>
double quadrature_to(double relative, Function const& f, double a, double b, int depth = 0) {
  auto const simple = [&f](double from, double to) {
    constexpr double node[] = {0.18343464249564980, 0.52553240991632899, 0.79666647741362674,
                               0.96028985649753623};
    constexpr double weight[] = {0.36268378337836198, 0.31370664587788729, 0.22238103445337447,
                                 0.10122853629037626};
    double sum = 0.0;
    for (int k = 0; k < 4; ++k) {
      for (double const sign : {-1.0, 1.0})
        sum += 0.5 * (to - from) * weight[k] * f(0.5 * (from + to) + 0.5 * (to - from) * sign * node[k]);
    }
    return sum;
  };
  double const middle = 0.5 * (a + b);
  double const whole = simple(a, b);
  double const halves = simple(a, middle) + simple(middle, b);
  if (depth > 2 && (depth > 20 || std::abs(whole - halves) < 0.02 * relative)) return halves;
  return quadrature_to(relative, f, a, middle, depth + 1) + quadrature_to(relative, f, middle, b, depth + 1);
}

/// int_0^R W r^(Dim-1) dr: eight points of Gauss are exact for each piece of the kernel.
template <int Dim>
double kernel_along_ray(double R, double h, Kernel const& W) {
  using Gauss = boost::math::quadrature::gauss<double, 8>;
  auto const shell = [&](double r) { return W.value(r, h) * (Dim == 2 ? r : r * r); };
  double sum = 0.0;
  for (double from = 0.0; from < R && from < W.support_ratio() * h; from += h)
    sum += Gauss::integrate(shell, from, std::min(R, from + h));
  return sum;
}

/// Gamma by rays: each leaves the fluid at the first of the walls. Adaptive quadrature adds up the
/// directions.
template <int Dim>
double brute_inner_fraction(Vector<Dim> const& x, std::vector<Wall<Dim>> const& walls, double h,
                            Kernel const& W) {
  auto const along = [&](Vector<Dim> const& u) {
    double R = W.support_ratio() * h;
    for (Wall<Dim> const& wall : walls) {
      double const approach = u.dot(wall.outward_normal);
      if (approach > 0.0) R = std::min(R, wall.distance(x) / approach);
    }
    return kernel_along_ray<Dim>(std::max(0.0, R), h, W);
  };
  if constexpr (Dim == 2) {
    // Cut where the ray leaves the kernel, passes its knot, runs along a wall or into a corner.
    std::vector<double> ends{0.0, 2.0 * pi};
    auto const add = [&ends](double phi) { ends.push_back(phi - 2.0 * pi * std::floor(0.5 * phi / pi)); };
    for (Wall<2> const& wall : walls) {
      Vector<2> const n = wall.outward_normal;
      std::vector<double> radii{1e300};
      for (double r = 1.0; r <= W.support_ratio(); r += 1.0) radii.push_back(r * h);
      for (double const r : radii) {
        if (wall.distance(x) > r) continue;
        for (double const sign : {-1.0, 1.0})
          add(std::atan2(n[1], n[0]) + sign * std::acos(wall.distance(x) / r));
      }
      for (Wall<2> const& other : walls) {
        Vector<2> const m = other.outward_normal;
        double const sine = n[0] * m[1] - n[1] * m[0];
        if (std::abs(sine) < 1e-12) continue;
        double const a = wall.distance(x) / sine;
        double const b = other.distance(x) / sine;
        add(std::atan2(b * n[0] - a * m[0], a * m[1] - b * n[1]));
      }
    }
    std::sort(ends.begin(), ends.end());
    double sum = 0.0;
    for (std::size_t k = 0; k + 1 < ends.size(); ++k)
      sum += quadrature(
          [&](double phi) {
            return along({std::cos(phi), std::sin(phi)});
          },
          ends[k], ends[k + 1]);
    return sum;
  } else {
    return quadrature_to(
        1e-7,
        [&](double z) {
          double const r = std::sqrt(1.0 - z * z);
          return quadrature_to(
              1e-8,
              [&](double phi) {
                return along({r * std::cos(phi), r * std::sin(phi), z});
              },
              0.0, 2.0 * pi);
        },
        -1.0, 1.0);
  }
}

/// Walls of a wedge of the given angle [rad] at the origin, symmetric about the first axis.
template <int Dim>
std::vector<Wall<Dim>> wedge(double angle) {
  Vector<Dim> up = Vector<Dim>::Zero(), down = Vector<Dim>::Zero();
  up[0] = down[0] = -std::sin(0.5 * angle);
  up[1] = std::cos(0.5 * angle);
  down[1] = -up[1];
  return {{.point = Vector<Dim>::Zero(), .outward_normal = up},
          {.point = Vector<Dim>::Zero(), .outward_normal = down}};
}

/// The walls of a square or cube of the given side at the origin.
template <int Dim>
std::vector<Wall<Dim>> box(double side) {
  std::vector<Wall<Dim>> walls;
  for (int k = 0; k < Dim; ++k) {
    walls.push_back({.point = Vector<Dim>::Zero(), .outward_normal = -Vector<Dim>::Unit(k)});
    walls.push_back({.point = Vector<Dim>::Constant(side), .outward_normal = Vector<Dim>::Unit(k)});
  }
  return walls;
}

/// A regular simplex around the origin, its faces 0.45 away, with one tip cut off.
template <int Dim>
std::vector<Wall<Dim>> truncated_simplex() {
  std::vector<Vector<Dim>> normals;
  if constexpr (Dim == 2) {
    for (int k = 0; k < 3; ++k) normals.push_back({std::cos(2.0 * pi * k / 3), std::sin(2.0 * pi * k / 3)});
  } else {
    normals = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  }
  std::vector<Wall<Dim>> walls;
  for (Vector<Dim> const& n : normals)
    walls.push_back({.point = 0.45 * n.normalized(), .outward_normal = n.normalized()});
  walls.push_back({.point = -0.7 * walls[0].outward_normal, .outward_normal = -walls[0].outward_normal});
  return walls;
}

/// Corners of many shapes, turned and moved at random.
template <int Dim>
std::vector<std::vector<Wall<Dim>>> shapes(Random& random) {
  std::vector<std::vector<Wall<Dim>>> list{box<Dim>(1.0), box<Dim>(0.7), truncated_simplex<Dim>()};
  for (double const degrees : {20.0, 60.0, 90.0, 120.0, 170.0})
    list.push_back(wedge<Dim>(degrees * pi / 180.0));
  if constexpr (Dim == 3) {
    for (double const degrees : {60.0, 120.0}) {  // closed by an inclined plane: a corner of three
      list.push_back(wedge<3>(degrees * pi / 180.0));
      list.back().push_back(
          {.point = {0.0, 0.0, 0.1}, .outward_normal = Vector<3>(-0.3, 0.2, 1.0).normalized()});
    }
  }
  for (auto& walls : list) {
    Matrix<Dim> const turn = random.rotation<Dim>();
    Vector<Dim> const shift = random.vector<Dim>(-1.0, 1.0);
    for (Wall<Dim>& wall : walls) {
      wall.point = turn * wall.point + shift;
      wall.outward_normal = turn * wall.outward_normal;
    }
  }
  return list;
}

/// A random point inside all walls, most of them near the first wall's point.
template <int Dim>
Vector<Dim> point_inside(std::vector<Wall<Dim>> const& walls, Random& random) {
  while (true) {
    Vector<Dim> const x = walls[0].point + random.vector<Dim>(-1.0, 1.0);
    if (std::all_of(walls.begin(), walls.end(), [&](auto const& wall) { return wall.distance(x) > 0.0; }))
      return x;
  }
}

template <int Dim>
Vector<Dim> sum_of_faces(Vector<Dim> const& x, std::vector<Wall<Dim>> const& walls, double h,
                         Kernel const& W) {
  Vector<Dim> sum = Vector<Dim>::Zero();
  for (std::size_t w = 0; w < walls.size(); ++w)
    sum += face_weight(x, walls, w, h, FaceWeight::exact, W) * walls[w].outward_normal;
  return sum;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(face_weights_in_corners_are_what_rings_add_up_to, D, MoreDimensions) {
  constexpr int Dim = D::value;
  for (Kernel const* W : all_kernels<Dim>()) {
    Random random(7);
    std::size_t cut = 0;
    double worst = 0.0;
    for (double const of_cubic : {0.1, 0.3, 0.5}) {
      double const h = of_same_support(of_cubic, *W);
      for (auto const& walls : shapes<Dim>(random)) {
        for (int n = 0; n < (Dim == 2 ? 20 : 4); ++n) {
          Vector<Dim> const x = point_inside(walls, random);
          for (std::size_t w = 0; w < walls.size(); ++w) {
            for (FaceWeight const rule : {FaceWeight::exact, FaceWeight::campbell}) {
              double const found = face_weight(x, walls, w, h, rule, *W);
              worst = std::max(worst, h * std::abs(found - brute_weight(x, walls, w, h, rule, *W)));
              cut += found < 0.99 * face_weight<Dim>(walls[w].distance(x), h, rule, *W) ? 1 : 0;
            }
          }
        }
      }
    }
    BOOST_TEST_MESSAGE(W->id() << " in " << Dim << "D: weights off by " << worst << " / h");
    BOOST_TEST(cut > 200u);
    BOOST_TEST(worst < 3e-14, W->id() << " off by " << worst << " / h");
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(part_of_the_kernel_inside_is_what_rays_add_up_to, D, MoreDimensions) {
  constexpr int Dim = D::value;
  for (Kernel const* W : all_kernels<Dim>()) {
    Random random(8);
    double worst = 0.0;
    for (double const of_cubic : {0.2, 0.5}) {
      if (Dim == 3 && of_cubic < 0.5 && W->id() != "cubic-spline") continue;  // rays in 3D take seconds
      double const h = of_same_support(of_cubic, *W);
      for (auto const& walls : shapes<Dim>(random)) {
        for (int n = 0; n < (Dim == 2 ? 40 : 1); ++n) {
          Vector<Dim> const x = point_inside(walls, random);
          double const expected = brute_inner_fraction(x, walls, h, *W);
          worst = std::max(worst, std::abs(inner_fraction(x, walls, h, *W) - expected));
        }
      }
    }
    BOOST_TEST_MESSAGE(W->id() << " in " << Dim << "D: Gamma off by " << worst);
    BOOST_TEST(worst < (Dim == 2 ? 1e-12 : 1e-6), W->id() << " off by " << worst);
  }
}

// The divergence theorem: grad Gamma = integral of grad_x W over the fluid = -sum_f A_f n_f.
BOOST_AUTO_TEST_CASE_TEMPLATE(faces_of_a_closed_cell_add_up_to_the_gradient_of_gamma, D, MoreDimensions) {
  constexpr int Dim = D::value;
  for (Kernel const* W : all_kernels<Dim>()) {
    Random random(9);
    double worst = 0.0;
    for (double const of_cubic : {0.1, 0.3, 0.6}) {
      double const h = of_same_support(of_cubic, *W);
      for (auto const& walls : shapes<Dim>(random)) {
        for (int n = 0; n < 40; ++n) {
          Vector<Dim> const x = point_inside(walls, random);
          double nearest = 1.0;
          for (auto const& wall : walls) nearest = std::min(nearest, wall.distance(x) / h);
          double const step = 1e-3 * h;
          if (nearest < 3e-3) continue;
          Vector<Dim> residual = sum_of_faces(x, walls, h, *W);
          for (int k = 0; k < Dim; ++k) {
            auto const gamma = [&](double steps) {
              Vector<Dim> const moved = x + steps * step * Vector<Dim>::Unit(k);
              return inner_fraction(moved, walls, h, *W);
            };
            residual[k] += (8.0 * (gamma(1.0) - gamma(-1.0)) - (gamma(2.0) - gamma(-2.0))) / (12.0 * step);
          }
          worst = std::max(worst, h * residual.norm());
        }
      }
    }
    BOOST_TEST_MESSAGE(W->id() << " in " << Dim << "D: largest residual " << worst << " / h");
    BOOST_TEST(worst < 1e-7, W->id() << ": residual " << worst << " / h");
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(on_edges_and_corners_gamma_is_the_share_of_the_directions, D, MoreDimensions) {
  constexpr int Dim = D::value;
  for (Kernel const* W : all_kernels<Dim>()) {
    Random random(10);
    for (double const degrees : {1.0, 20.0, 60.0, 90.0, 120.0, 179.0}) {
      Matrix<Dim> const turn = random.rotation<Dim>();
      Vector<Dim> const shift = random.vector<Dim>(-10.0, 10.0);
      auto walls = wedge<Dim>(degrees * pi / 180.0);
      for (Wall<Dim>& wall : walls) {
        wall.point = turn * wall.point + shift;
        wall.outward_normal = turn * wall.outward_normal;
      }
      BOOST_TEST(std::abs(inner_fraction<Dim>(shift, walls, 0.1, *W) - degrees / 360.0) < 1e-12);
      // On the face, far from the edge.
      Vector<Dim> in = Vector<Dim>::Zero();
      in[0] = std::cos(degrees * pi / 360.0);
      in[1] = std::sin(degrees * pi / 360.0);
      if (degrees >= 20.0)
        BOOST_TEST(std::abs(inner_fraction<Dim>(turn * in + shift, walls, 0.1, *W) - 0.5) < 1e-12);
    }
    auto const walls = box<Dim>(1.0);
    Vector<Dim> x = Vector<Dim>::Zero();
    for (int k = Dim - 1; k >= 0; --k) {
      BOOST_TEST(std::abs(inner_fraction(x, walls, 0.1, *W) - std::pow(0.5, k + 1)) < 1e-12);
      BOOST_TEST(std::abs(wall_interpolation_factor(x, walls, 0.1, *W) - std::pow(2.0, k + 1)) < 1e-11);
      x[k] = 0.5;
    }
    BOOST_TEST(inner_fraction(x, walls, 0.1, *W) == 1.0);
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(what_no_other_wall_cuts_keeps_every_bit, D, Dimensions) {
  constexpr int Dim = D::value;
  Random random(11);
  Vector<Dim> const n = random.direction<Dim>();
  std::vector<Wall<Dim>> walls{{.point = Vector<Dim>::Zero(), .outward_normal = n},
                               {.point = -0.8 * n, .outward_normal = -n}};  // within the support
  std::vector<Wall<Dim>> const parallel = walls;
  if constexpr (Dim > 1) {
    Vector<Dim> const other = random.direction<Dim>();
    Vector<Dim> const across = (other - other.dot(n) * n).normalized();
    walls.push_back({.point = 1.05 * across, .outward_normal = across});
  }
  double const h = 0.53;
  Vector<Dim> const x = -0.3 * n;
  double beyond = 1.0;
  for (std::size_t w = 0; w < 2; ++w) {
    double const d = walls[w].distance(x);
    for (FaceWeight const rule : {FaceWeight::exact, FaceWeight::campbell})
      BOOST_TEST(face_weight(x, walls, w, h, rule, default_kernel(Dim)) ==
                 face_weight<Dim>(d, h, rule, default_kernel(Dim)));
    beyond -= 1.0 - default_kernel(Dim).inner_fraction(d, h);
  }
  BOOST_TEST(inner_fraction(x, parallel, h, default_kernel(Dim)) == beyond);
  BOOST_TEST(std::abs(inner_fraction(x, parallel, h, default_kernel(Dim)) - beyond) < 1e-15);
  BOOST_TEST(wall_interpolation_factor<Dim>(Vector<Dim>::Zero(), parallel, 0.3, default_kernel(Dim)) == 2.0);
  double const both = wall_interpolation_factor<Dim>(Vector<Dim>::Zero(), parallel, h, default_kernel(Dim));
  BOOST_TEST(both == 1.0 / (dense::inner_fraction<Dim>(0.8, h) - 0.5), tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(weight_of_a_face_that_leaves_the_support_loses_no_digits, D, MoreDimensions) {
  constexpr int Dim = D::value;
  auto const walls = wedge<Dim>(120.0 * pi / 180.0);
  // Straight below the second face's end of the first: the first is seen from beyond its edge.
  Vector<Dim> direction = Vector<Dim>::Zero();
  direction[0] = std::cos(0.25 * pi);
  direction[1] = -std::sin(0.25 * pi);
  double last = 1.0;
  for (double gap = 1e-1; gap > 1e-6; gap *= 0.1) {
    Vector<Dim> const x = (2.0 - gap) * direction;
    double const found = face_weight(x, walls, 0, 1.0, FaceWeight::exact, default_kernel(Dim));
    BOOST_TEST(found > 0.0);
    BOOST_TEST(found < 0.01 * last);
    last = found;
  }
  Vector<Dim> const near = 1.99 * direction;
  BOOST_TEST(face_weight(near, walls, 0, 1.0, FaceWeight::exact, default_kernel(Dim)) ==
                 brute_weight(near, walls, 0, 1.0, FaceWeight::exact, default_kernel(Dim)),
             tolerance(1e-7));
  Vector<Dim> const out_of_reach = 2.0001 * direction;
  BOOST_TEST(walls[0].distance(out_of_reach) < 2.0);
  BOOST_TEST(face_weight(out_of_reach, walls, 0, 1.0, FaceWeight::exact, default_kernel(Dim)) == 0.0);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(walls_that_bound_nothing_change_nothing, D, MoreDimensions) {
  constexpr int Dim = D::value;
  auto const walls = wedge<Dim>(0.5 * pi);
  auto more = walls;
  more.push_back(
      {.point = Vector<Dim>::Zero(), .outward_normal = -Vector<Dim>::Unit(0)});  // through the edge
  more.push_back({.point = -0.1 * Vector<Dim>::Unit(0), .outward_normal = -Vector<Dim>::Unit(0)});
  Vector<Dim> behind = walls[0].point + 0.2 * walls[0].outward_normal;
  more.push_back({.point = behind, .outward_normal = walls[0].outward_normal});
  Random random(12);
  for (int n = 0; n < 20; ++n) {
    Vector<Dim> const x = 0.3 * point_inside(walls, random);
    for (std::size_t w = 0; w < 2; ++w) {
      double const alone = face_weight(x, walls, w, 0.5, FaceWeight::exact, default_kernel(Dim));
      BOOST_TEST(std::abs(face_weight(x, more, w, 0.5, FaceWeight::exact, default_kernel(Dim)) - alone) <
                 1e-13);
    }
    for (std::size_t w = 2; w < 5; ++w)
      BOOST_TEST(std::abs(face_weight(x, more, w, 0.5, FaceWeight::exact, default_kernel(Dim))) < 1e-13);
    BOOST_TEST(std::abs(inner_fraction(x, more, 0.5, default_kernel(Dim)) -
                        inner_fraction(x, walls, 0.5, default_kernel(Dim))) < 1e-13);
    BOOST_TEST(nearest_on_face(x, more, 3, 0.5).has_value() == false);
    BOOST_TEST(nearest_on_face(x, more, 4, 0.5).has_value() == false);
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(nearest_point_is_on_the_face_and_none_is_nearer, D, MoreDimensions) {
  constexpr int Dim = D::value;
  Random random(13);
  std::size_t moved = 0;
  for (auto const& walls : shapes<Dim>(random)) {
    for (int n = 0; n < 50; ++n) {
      Vector<Dim> const x = point_inside(walls, random);
      for (std::size_t w = 0; w < walls.size(); ++w) {
        auto const nearest = nearest_on_face(x, walls, w, 0.3);
        BOOST_TEST_REQUIRE(nearest.has_value());
        Vector<Dim> const foot = walls[w].foot(x);
        moved += *nearest != foot ? 1 : 0;
        BOOST_TEST(std::abs(walls[w].distance(*nearest)) < 1e-13);
        for (Wall<Dim> const& wall : walls) BOOST_TEST(wall.distance(*nearest) > -1e-12);
        // A convex set's nearest point is where no way along the face leads nearer.
        for (int k = 0; k < 20; ++k) {
          Vector<Dim> y = *nearest + random.vector<Dim>(-0.05, 0.05);
          y += walls[w].distance(y) * walls[w].outward_normal;
          bool const on_face = std::all_of(walls.begin(), walls.end(),
                                           [&](auto const& wall) { return wall.distance(y) > -1e-13; });
          if (on_face) BOOST_TEST((y - x).norm() > (*nearest - x).norm() - 1e-13);
        }
      }
    }
  }
  BOOST_TEST(moved > 50u);
}

BOOST_AUTO_TEST_CASE(in_one_dimension_only_the_nearer_of_two_walls_that_face_the_same_way_counts) {
  std::vector<Wall<1>> const walls{{.point = Vector<1>(0.0), .outward_normal = Vector<1>(-1.0)},
                                   {.point = Vector<1>(-0.1), .outward_normal = Vector<1>(-1.0)},
                                   {.point = Vector<1>(0.5), .outward_normal = Vector<1>(1.0)}};
  Vector<1> const x(0.2);
  BOOST_TEST(face_weight(x, walls, 0, 0.3, FaceWeight::exact, default_kernel(1)) ==
             default_kernel(1).value(0.2, 0.3));
  BOOST_TEST(face_weight(x, walls, 1, 0.3, FaceWeight::exact, default_kernel(1)) == 0.0);
  double const expected = dense::inner_fraction<1>(0.2, 0.3) + dense::inner_fraction<1>(0.3, 0.3) - 1.0;
  BOOST_TEST(inner_fraction(x, walls, 0.3, default_kernel(1)) == expected, tolerance(1e-13));
  BOOST_TEST(!nearest_on_face(x, walls, 1, 0.3).has_value());
  BOOST_TEST((*nearest_on_face(x, walls, 2, 0.3))[0] == 0.5);
}

BOOST_AUTO_TEST_SUITE_END()
