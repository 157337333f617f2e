// A sweep of two keys with all its parts.
#pragma once

#include <string>

namespace havers::test {

inline const std::string small_sweep = R"(
[sweep]
name = "Small"
sample = "grid"
seeds = 3
[sweep.keys]
"joints.scatter" = [0.2, 0.8]
"joints.distribution" = ["uniform", "weibull"]
[assembly]
layers = 4
fibres = 3
[solver]
regime = "quasi-static"
[[law]]
response = "strength"
terms = ["joints.scatter"]
[[finding]]
id = "A"
test = "falls"
keys = ["joints.scatter"]
[[figure]]
x = "joints.scatter"
)";

}  // namespace havers::test
