// What a test tells that was stopped before its specimen broke (F25).
#pragma once

namespace havers::calib {

/// Of a lower bound, z = (simulated − bound)/s: minus the root of −2 log Φ(z), so that half of its
/// square is −log of the chance of a strength beyond the bound. 0 far above it, z far below. [-]
double residual_of_bound(double z);

/// d residual_of_bound / dz: 0 far above the bound, 1 far below. [-]
double slope_of_bound(double z);

/// z φ(z)/Φ(z): what a bound takes, where z² of a residual adds, when the likeliest s is asked
/// for. [-]
double square_of_bound(double z);

}  // namespace havers::calib
