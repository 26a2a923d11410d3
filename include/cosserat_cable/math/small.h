// Three-vectors, 3x3 matrices and quaternions over any scalar T: double, or several cables side by
// side in the lanes of a vector type. Plain aggregates, no expression templates: the compiler sees
// straight-line code, and translation units built for other instruction sets stay compatible.
#pragma once

#include <cmath>

#include "lanes.h"

namespace cosserat_cable {

template <class T>
struct Vec3 {
  T x{}, y{}, z{};

  Vec3& operator+=(const Vec3& b) { x += b.x; y += b.y; z += b.z; return *this; }
  Vec3& operator-=(const Vec3& b) { x -= b.x; y -= b.y; z -= b.z; return *this; }
};

template <class T>
Vec3<T> operator+(const Vec3<T>& a, const Vec3<T>& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
template <class T>
Vec3<T> operator-(const Vec3<T>& a, const Vec3<T>& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
template <class T>
Vec3<T> operator-(const Vec3<T>& a) { return {-a.x, -a.y, -a.z}; }
template <class S, class T>
Vec3<T> operator*(const S& s, const Vec3<T>& a) { return {s * a.x, s * a.y, s * a.z}; }
template <class T>
T Dot(const Vec3<T>& a, const Vec3<T>& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
template <class T>
Vec3<T> Cross(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// Componentwise product: a diagonal matrix times a vector.
template <class T>
Vec3<T> Scale(const Vec3<T>& diagonal, const Vec3<T>& a) {
  return {diagonal.x * a.x, diagonal.y * a.y, diagonal.z * a.z};
}

/// Row-major 3x3 matrix.
template <class T>
struct Mat3 {
  T m[3][3]{};

  T* operator[](int row) { return m[row]; }
  const T* operator[](int row) const { return m[row]; }
  Mat3& operator+=(const Mat3& b) {
#pragma GCC unroll 3
    for (int i = 0; i < 3; ++i)
#pragma GCC unroll 3
      for (int j = 0; j < 3; ++j) m[i][j] += b.m[i][j];
    return *this;
  }
};

template <class T>
Mat3<T> operator+(Mat3<T> a, const Mat3<T>& b) { return a += b; }
template <class T>
Mat3<T> operator-(const Mat3<T>& a, const Mat3<T>& b) {
  Mat3<T> c;
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i)
#pragma GCC unroll 3
    for (int j = 0; j < 3; ++j) c[i][j] = a[i][j] - b[i][j];
  return c;
}
template <class T>
Mat3<T> operator-(const Mat3<T>& a) {
  Mat3<T> c;
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i)
#pragma GCC unroll 3
    for (int j = 0; j < 3; ++j) c[i][j] = -a[i][j];
  return c;
}
template <class T>
Mat3<T> operator*(const T& s, const Mat3<T>& a) {
  Mat3<T> c;
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i)
#pragma GCC unroll 3
    for (int j = 0; j < 3; ++j) c[i][j] = s * a[i][j];
  return c;
}
template <class T>
Vec3<T> operator*(const Mat3<T>& a, const Vec3<T>& b) {
  return {a[0][0] * b.x + a[0][1] * b.y + a[0][2] * b.z,
          a[1][0] * b.x + a[1][1] * b.y + a[1][2] * b.z,
          a[2][0] * b.x + a[2][1] * b.y + a[2][2] * b.z};
}
/// a^T b without forming the transpose.
template <class T>
Vec3<T> TransposeTimes(const Mat3<T>& a, const Vec3<T>& b) {
  return {a[0][0] * b.x + a[1][0] * b.y + a[2][0] * b.z,
          a[0][1] * b.x + a[1][1] * b.y + a[2][1] * b.z,
          a[0][2] * b.x + a[1][2] * b.y + a[2][2] * b.z};
}
template <class T>
Mat3<T> operator*(const Mat3<T>& a, const Mat3<T>& b) {
  Mat3<T> c;
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i)
#pragma GCC unroll 3
    for (int j = 0; j < 3; ++j)
      c[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j];
  return c;
}
template <class T>
Mat3<T> Transpose(const Mat3<T>& a) {
  Mat3<T> c;
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i)
#pragma GCC unroll 3
    for (int j = 0; j < 3; ++j) c[i][j] = a[j][i];
  return c;
}
/// a [v]x : every row of `a` crossed with v, since row . (v x w) = (row x v) . w.
template <class T>
Mat3<T> TimesCross(const Mat3<T>& a, const Vec3<T>& v) {
  Mat3<T> c;
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i) {
    c[i][0] = a[i][1] * v.z - a[i][2] * v.y;
    c[i][1] = a[i][2] * v.x - a[i][0] * v.z;
    c[i][2] = a[i][0] * v.y - a[i][1] * v.x;
  }
  return c;
}
/// [v]x a : v crossed with every column of `a`.
template <class T>
Mat3<T> CrossTimes(const Vec3<T>& v, const Mat3<T>& a) {
  Mat3<T> c;
#pragma GCC unroll 3
  for (int j = 0; j < 3; ++j) {
    c[0][j] = v.y * a[2][j] - v.z * a[1][j];
    c[1][j] = v.z * a[0][j] - v.x * a[2][j];
    c[2][j] = v.x * a[1][j] - v.y * a[0][j];
  }
  return c;
}
/// diag(d) a
template <class T>
Mat3<T> ScaleRows(const Vec3<T>& d, const Mat3<T>& a) {
  Mat3<T> c;
#pragma GCC unroll 3
  for (int j = 0; j < 3; ++j) {
    c[0][j] = d.x * a[0][j];
    c[1][j] = d.y * a[1][j];
    c[2][j] = d.z * a[2][j];
  }
  return c;
}
/// [v]x, so that [v]x w = v x w.
template <class T>
Mat3<T> CrossMatrix(const Vec3<T>& v) {
  return {{{T(0), -v.z, v.y}, {v.z, T(0), -v.x}, {-v.y, v.x, T(0)}}};
}
template <class T>
Mat3<T> Outer(const Vec3<T>& a, const Vec3<T>& b) {
  return {{{a.x * b.x, a.x * b.y, a.x * b.z},
           {a.y * b.x, a.y * b.y, a.y * b.z},
           {a.z * b.x, a.z * b.y, a.z * b.z}}};
}

/// Unit quaternion w + (x, y, z): the rotation from the section's frame to the world.
template <class T>
struct Quat {
  T w{}, x{}, y{}, z{};

  Vec3<T> vec() const { return {x, y, z}; }
};

template <class T>
Quat<T> operator*(const Quat<T>& a, const Quat<T>& b) {
  return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z,
          a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
          a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
          a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}
template <class T>
Quat<T> Conjugate(const Quat<T>& a) { return {a.w, -a.x, -a.y, -a.z}; }
template <class T>
T Dot(const Quat<T>& a, const Quat<T>& b) { return a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z; }
template <class T>
Quat<T> Normalized(const Quat<T>& a) {
  using std::sqrt;
  const T s = T(1) / sqrt(Dot(a, a));
  return {s * a.w, s * a.x, s * a.y, s * a.z};
}
template <class T>
Mat3<T> ToMatrix(const Quat<T>& q) {
  const T x2 = q.x + q.x, y2 = q.y + q.y, z2 = q.z + q.z;
  const T xx = q.x * x2, yy = q.y * y2, zz = q.z * z2;
  const T xy = q.x * y2, xz = q.x * z2, yz = q.y * z2;
  const T wx = q.w * x2, wy = q.w * y2, wz = q.w * z2;
  return {{{T(1) - yy - zz, xy - wz, xz + wy},
           {xy + wz, T(1) - xx - zz, yz - wx},
           {xz - wy, yz + wx, T(1) - xx - yy}}};
}

/// The same, each number rounded to the other's precision.
template <class To, class From>
Vec3<To> Converted(const Vec3<From>& v) {
  return {Converted<To>(v.x), Converted<To>(v.y), Converted<To>(v.z)};
}
template <class To, class From>
Mat3<To> Converted(const Mat3<From>& a) {
  Mat3<To> c;
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i)
#pragma GCC unroll 3
    for (int j = 0; j < 3; ++j) c[i][j] = Converted<To>(a[i][j]);
  return c;
}

template <class To, class From>
Quat<To> Converted(const Quat<From>& q) {
  return {Converted<To>(q.w), Converted<To>(q.x), Converted<To>(q.y), Converted<To>(q.z)};
}

}  // namespace cosserat_cable
