// What models without mechanics leave of the same records: against them one sees what physics buys.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "cosserat_cable/fit/record_model.h"
#include "cosserat_cable/measurement/measurement_set.h"

namespace cosserat_cable {

/// Root mean squares of what is left of a channel's usable samples; NaN where there is no such
/// model.
struct ReferenceResiduals {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  double constant = kNone;  ///< of the channel's mean
  /// Of a linear filter: sums of the clamps' positions and directions over their last 0.6 s, with
  /// weights that are the same in all records that have the channel, found from these records by
  /// least squares (ridge regression).
  double filter = kNone;
  double filter_unseen = kNone;  ///< the same, with weights from the other records
};

/// By experiment and channel. `usable`: one for samples that count.
std::vector<std::vector<ReferenceResiduals>> FindReferenceResiduals(const MeasurementSet& set,
                                                                    const Records& usable);

}  // namespace cosserat_cable
