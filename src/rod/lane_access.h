// What belongs to one lane of the kernel's types, in and out.
#pragma once

#include "step_chain.h"

namespace cosserat_cable::rod {

using cosserat_cable::GetLane;
using cosserat_cable::SetLane;

template <class T>
Vec3<double> GetLane(const Vec3<T>& v, int lane) {
  return {GetLane(v.x, lane), GetLane(v.y, lane), GetLane(v.z, lane)};
}
template <class T>
void SetLane(Vec3<T>* v, int lane, const Vec3<double>& value) {
  SetLane(&v->x, lane, value.x);
  SetLane(&v->y, lane, value.y);
  SetLane(&v->z, lane, value.z);
}

template <class T>
Quat<double> GetLane(const Quat<T>& q, int lane) {
  return {GetLane(q.w, lane), GetLane(q.x, lane), GetLane(q.y, lane), GetLane(q.z, lane)};
}
template <class T>
void SetLane(Quat<T>* q, int lane, const Quat<double>& value) {
  SetLane(&q->w, lane, value.w);
  SetLane(&q->x, lane, value.x);
  SetLane(&q->y, lane, value.y);
  SetLane(&q->z, lane, value.z);
}

template <class T>
void SetLane(Node<T>* node, int lane, const Node<double>& value) {
  SetLane(&node->r, lane, value.r);
  SetLane(&node->q, lane, value.q);
  SetLane(&node->v, lane, value.v);
  SetLane(&node->omega, lane, value.omega);
}

template <class T>
Node<double> GetLane(const Node<T>& node, int lane) {
  return {GetLane(node.r, lane), GetLane(node.q, lane), GetLane(node.v, lane),
          GetLane(node.omega, lane)};
}
template <class T>
NodeRates<double> GetLane(const NodeRates<T>& rates, int lane) {
  return {GetLane(rates.v, lane), GetLane(rates.omega, lane)};
}
template <class T>
void SetLane(NodeRates<T>* rates, int lane, const NodeRates<double>& value) {
  SetLane(&rates->v, lane, value.v);
  SetLane(&rates->omega, lane, value.omega);
}

template <class T>
Persistence<double> GetLane(const Persistence<T>& persistence, int lane) {
  return {GetLane(persistence.v, lane), GetLane(persistence.omega, lane)};
}
template <class T>
void SetLane(Persistence<T>* persistence, int lane, const Persistence<double>& value) {
  SetLane(&persistence->v, lane, value.v);
  SetLane(&persistence->omega, lane, value.omega);
}

template <class T>
void SetLane(Bowing<T>* bowing, int lane, const Bowing<double>& value) {
  SetLane(&bowing->along_normal, lane, value.along_normal);
  SetLane(&bowing->along_chord, lane, value.along_chord);
  SetLane(&bowing->twist, lane, value.twist);
  SetLane(&bowing->bend_x, lane, value.bend_x);
  SetLane(&bowing->bend_y, lane, value.bend_y);
}
template <class T>
Bowing<double> GetLane(const Bowing<T>& b, int lane) {
  return {GetLane(b.along_normal, lane), GetLane(b.along_chord, lane), GetLane(b.twist, lane),
          GetLane(b.bend_x, lane), GetLane(b.bend_y, lane)};
}

template <class T>
void SetLane(BeamColumnAxis<T>* axis, int lane, const BeamColumnAxis<double>& value) {
  SetLane(&axis->slenderness, lane, value.slenderness);
  SetLane(&axis->C_M, lane, value.C_M);
  SetLane(&axis->V_M, lane, value.V_M);
  SetLane(&axis->C_F, lane, value.C_F);
  SetLane(&axis->V_F, lane, value.V_F);
}
template <class T>
void SetLane(BeamColumn<T>* column, int lane, const BeamColumn<double>& value) {
  SetLane(&column->x, lane, value.x);
  SetLane(&column->y, lane, value.y);
  SetLane(&column->bend, lane, value.bend);
  SetLane(&column->shear, lane, value.shear);
}

template <class T>
AxisStiffening<double> GetLane(const AxisStiffening<T>& axis, int lane) {
  return {GetLane(axis.C_M, lane), GetLane(axis.V_M, lane), GetLane(axis.C_F, lane),
          GetLane(axis.V_F, lane)};
}
template <class T>
void SetLane(AxisStiffening<T>* axis, int lane, const AxisStiffening<double>& value) {
  SetLane(&axis->C_M, lane, value.C_M);
  SetLane(&axis->V_M, lane, value.V_M);
  SetLane(&axis->C_F, lane, value.C_F);
  SetLane(&axis->V_F, lane, value.V_F);
}
template <class T>
void SetLane(Stiffening<T>* by, int lane, const Stiffening<double>& value) {
  SetLane(&by->x, lane, value.x);
  SetLane(&by->y, lane, value.y);
  SetLane(&by->bend_x, lane, value.bend_x);
  SetLane(&by->bend_y, lane, value.bend_y);
  SetLane(&by->along_chord, lane, value.along_chord);
}
template <class T>
Stiffening<double> GetLane(const Stiffening<T>& by, int lane) {
  return {GetLane(by.x, lane), GetLane(by.y, lane), GetLane(by.bend_x, lane),
          GetLane(by.bend_y, lane), GetLane(by.along_chord, lane)};
}

template <class T>
void SetLane(ElementLaw<T>* law, int lane, const ElementLaw<double>& value) {
  SetLane(&law->h, lane, value.h);
  SetLane(&law->C_F, lane, value.C_F);
  SetLane(&law->C_M, lane, value.C_M);
  SetLane(&law->V_F, lane, value.V_F);
  SetLane(&law->V_M, lane, value.V_M);
  SetLane(&law->gamma0, lane, value.gamma0);
  SetLane(&law->bowing, lane, value.bowing);
  SetLane(&law->column, lane, value.column);
}

template <class T>
void SetLane(ShearStep<T>* step, int lane, const ShearStep<double>& value) {
  SetLane(&step->decay, lane, value.decay);
  SetLane(&step->weight_old, lane, value.weight_old);
  SetLane(&step->weight_new, lane, value.weight_new);
  SetLane(&step->carried, lane, value.carried);
  SetLane(&step->target_C, lane, value.target_C);
  SetLane(&step->target_V, lane, value.target_V);
  SetLane(&step->lambda, lane, value.lambda);
  SetLane(&step->eta_GA, lane, value.eta_GA);
  SetLane(&step->eta_B, lane, value.eta_B);
}

template <class T>
Vec6<double> GetLane(const Vec6<T>& v, int lane) {
  return {{GetLane(v[0], lane), GetLane(v[1], lane), GetLane(v[2], lane), GetLane(v[3], lane),
           GetLane(v[4], lane), GetLane(v[5], lane)}};
}

template <class T>
ShearHistory GetLane(const ChainShear<T>& shear, int lane) {
  return {{{GetLane(shear.x.g1, lane), GetLane(shear.x.G, lane)},
           {GetLane(shear.y.g1, lane), GetLane(shear.y.G, lane)}}};
}
template <class T>
void SetLane(ChainShear<T>* shear, int lane, const ShearHistory& value) {
  SetLane(&shear->x.g1, lane, value[0].g1);
  SetLane(&shear->x.G, lane, value[0].G);
  SetLane(&shear->y.g1, lane, value[1].g1);
  SetLane(&shear->y.G, lane, value[1].G);
}

}  // namespace cosserat_cable::rod
