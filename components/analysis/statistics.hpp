#pragma once

#include "core/simulation/catalogue.hpp"

namespace tushar::analysis {

/// `statistics`: means and central moments over time of cell variables, as variables that can be saved. With `X` the
/// name of a variable in the scene (without `c.`) and <> the mean over the samples, it computes
///
/// | saved as | |
/// |---|---|
/// | mean_X, mean2_X | <X>, <X²> |
/// | variance_X | <(X - <X>)²> |
/// | skewness_X, kurtosis_X | the third and the fourth central moment, with computeHigherOrderStats |
/// | uv_vw_wu_prime, mean_uv_vw_wu | <u'v'>, <v'w'>, <w'u'> of a velocity with computeReynoldsStress, and <uv>, … |
/// | sum_X, sum2_X, sum_uv_vw_wu | the number of samples times the means |
///
/// Every step that ends between timeStart and timeStop is a sample. Before the first, all are 0.
simulation::AnalysisKind statisticsKind();

/// `turbulentFluxes`: the same of variables, and their covariances with a velocity, the variable with
/// fluidVelocityLabel:
///
/// | saved as | |
/// |---|---|
/// | mean_X, mean_X2, variance_X, sum_X, sum_X2 | as above |
/// | covariance_X | <X'u'>, <X'v'>, <X'w'>; of a vector (a, b, c): <a'v'>, <b'w'>, <c'u'> |
/// | mean_Qu_Qv_Qw_X, sum_Qu_Qv_Qw_X | the same without primes, and times the number of samples |
simulation::AnalysisKind turbulentFluxesKind();

}  // namespace tushar::analysis
