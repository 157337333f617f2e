#include "calib/experiment/signal_rates.hpp"

#include <algorithm>
#include <functional>
#include <numeric>

#include "calib/experiment/channel_noise.hpp"

namespace havers::calib {
namespace {

// The rate at which half of the way up is made: that of the loading, however many rows are idle. 0
// where the signal never rises. [unit / s]
double loading_rate(std::vector<double> rates) {
  std::erase_if(rates, [](double rate) { return rate <= 0.0; });
  std::ranges::sort(rates, std::greater{});
  const double half = 0.5 * std::accumulate(rates.begin(), rates.end(), 0.0);
  double travelled = 0.0;
  for (const double rate : rates)
    if ((travelled += rate) >= half) return rate;
  return 0.0;
}

}  // namespace

double SignalRates::at(double time) const {
  const double place = (time - start) / step;
  if (place < 0.0 || place >= static_cast<double>(value.size() - 1)) return 0.0;
  const auto i = static_cast<std::size_t>(place);
  const double part = place - static_cast<double>(i);
  return (1.0 - part) * value[i] + part * value[i + 1];
}

double value_at(const Signal& signal, double time) {
  // The first row later than `time`, so that the two rows around it differ in time.
  const auto after = std::ranges::upper_bound(signal.time, time);
  if (after == signal.time.begin()) return signal.value.front();
  if (after == signal.time.end()) return signal.value.back();
  const auto i = static_cast<std::size_t>(after - signal.time.begin());
  const double part = (time - signal.time[i - 1]) / (signal.time[i] - signal.time[i - 1]);
  return (1.0 - part) * signal.value[i - 1] + part * signal.value[i];
}

double telling_step(const Signal& signal) {
  const double span = signal.time.back() - signal.time.front();
  const auto [low, high] = std::ranges::minmax(signal.value);
  std::vector<double> steps;
  for (std::size_t i = 1; i < signal.time.size(); ++i)
    steps.push_back(signal.time[i] - signal.time[i - 1]);
  // A grid has 4000 steps at most.
  const double sampling = std::max(median(std::move(steps)), span / 4000.0);
  if (high <= low) return sampling;
  // In one step steady loading moves the signal by so many times its noise, where that leaves a
  // hundred steps or more.
  constexpr double above_noise = 14.0;
  const double noise = noise_of(signal.value);
  return std::clamp(above_noise * noise * span / (high - low), sampling,
                    std::max(sampling, span / 100.0));
}

SignalRates rates_of(const Signal& signal, double step) {
  SignalRates rates{.start = signal.time.front() + 0.5 * step, .step = step, .value = {}};
  double before = signal.value.front();
  for (double time = signal.time.front() + step; time <= signal.time.back(); time += step) {
    const double now = value_at(signal, time);
    rates.value.push_back((now - before) / step);
    before = now;
  }
  // Without the clip a break would be nearly all that a correlation sees.
  const double clip = 2.0 * loading_rate(rates.value);
  if (clip > 0.0)
    for (double& rate : rates.value) rate = std::clamp(rate, -clip, clip);
  return rates;
}

}  // namespace havers::calib
