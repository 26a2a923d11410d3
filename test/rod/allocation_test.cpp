// Steps allocate nothing: what they cost does not depend on the allocator, and memory does not
// grow. Not under the address sanitizer, which brings operators of its own.
#ifndef __SANITIZE_ADDRESS__
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "cosserat_cable/rod/bending_friction.h"
#include "cosserat_cable/rod/clamp_friction.h"
#include "cosserat_cable/rod/clamp_play.h"
#include "cosserat_cable/rod/point_loads.h"
#include "cosserat_cable/rod/rod_batch.h"
#include "rod/rod_cases.h"

namespace {

std::atomic<long> allocations{0};

void* Allocate(std::size_t size, std::size_t alignment) {
  ++allocations;
  const std::size_t rounded = (size + alignment - 1) / alignment * alignment;
  void* memory = std::aligned_alloc(alignment, rounded > 0 ? rounded : alignment);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace

// Of the whole test program.
void* operator new(std::size_t size) { return Allocate(size, alignof(std::max_align_t)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return Allocate(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

namespace cosserat_cable::rod {
namespace {

constexpr double kDt = 1e-3;
constexpr int kSteps = 50;
const Pose kA;
const Pose kB{{0.1, 0, 0}, Eigen::Quaterniond(0, 0, 1, 0)};

RodModel Cable(int elements) {
  return RoundCable(0.2, 0.008, 0.15, 0.008, 0.006, 1e-4, 5e-5, elements);
}

Rod Arch(const RodModel& model) {
  Rod rod(model);
  rod.SetConfiguration(BowedShape(kA, kB, model.length, model.elements, model.gravity));
  EXPECT_TRUE(rod.Equilibrate().converged);
  return rod;
}

/// Clamps that rub and are loose, and a load of the model's.
RodModel Extended(int elements) {
  RodModel model = Cable(elements);
  model.a = EndModel::Sprung({0.1, 0.1, 0.1}, Eigen::Vector3d::Zero());
  model.a.laws = {std::make_shared<ClampFriction>(0.5, 1e-3), std::make_shared<ClampPlay>(0.01, 1)};
  model.b = model.a;
  model.loads = {std::make_shared<PointLoads>(0.2, std::vector<PointLoad>{{0.1, {0, 0.1, 0}}})};
  return model;
}

Pose Shifted(Pose clamp, int step) {
  clamp.p.x() += 1e-3 * std::sin(0.2 * step);
  return clamp;
}

TEST(AllocationTest, TheCounterCounts) {
  const long before = allocations;
  ::operator delete(::operator new(8));
  EXPECT_EQ(allocations - before, 1);
}

TEST(AllocationTest, ASingleRodsStepsAllocateNothing) {
  for (const RodModel& model : {Cable(41), Extended(41)}) {
    Rod rod = Arch(model);
    const PointLoads load(0.2, {{0.07, {0.1, 0.2, 0}}});
    ASSERT_TRUE(rod.Step(kDt, kA, kB, &load).converged);  // sets up its memory
    const long before = allocations;
    bool converged = true;
    for (int s = 1; s <= kSteps; ++s)
      converged &= rod.Step(kDt, Shifted(kA, s), Shifted(kB, s), &load).converged;
    EXPECT_EQ(allocations - before, 0);
    EXPECT_TRUE(converged);
  }
}

TEST(AllocationTest, ABatchsStepsAllocateNothing) {
  for (const int count : {3, 4, 7}) {
    std::vector<Rod> rods(count, Arch(count == 4 ? Extended(40) : Cable(40)));
    std::vector<Rod*> pointers;
    for (Rod& rod : rods) pointers.push_back(&rod);
    RodBatch batch(pointers);
    std::vector<RodDrive> drives(count);
    bool converged = true;
    const long before = allocations;
    for (int s = 1; s <= kSteps; ++s) {
      const Pose a = Shifted(kA, s), b = Shifted(kB, s);
      for (RodDrive& drive : drives) drive = {&a, &b, nullptr};
      for (const SolveReport& report : batch.Step(kDt, drives)) converged &= report.converged;
    }
    EXPECT_EQ(allocations - before, 0) << count;
    EXPECT_TRUE(converged);
  }
}

}  // namespace
}  // namespace cosserat_cable::rod
#endif
