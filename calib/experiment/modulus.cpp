// The window where the curve is straight is found first, by the slopes of its parts. The line is
// then fitted in it, or by a convention where nothing is straight.
#include "calib/experiment/modulus.hpp"

#include <fmt/format.h>
#include <gsl/gsl_statistics_double.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "calib/experiment/channel_noise.hpp"
#include "calib/experiment/damped_wave.hpp"

namespace havers::calib {
namespace {

constexpr std::size_t fewest_half_window = 5;  // of a half window whose slope is to tell something
constexpr double narrowing_step = 0.1;         // part of the window's stress range
constexpr double fewest_remaining = 0.3;  // a window shorter than this part shows no straight line
constexpr double yielded = 0.5;           // slope ratio of the halves that only yielding explains
constexpr double before_failure = 0.9;    // of the strength: what follows may be failure already
constexpr int waves = 5;                  // swings of the slope that no toe and yielding make
constexpr double gentle_toe = 1.1;        // slope after to slope in it; else a gauge may slide
// Strains of the window of ISO 527-1, for curves without a straight part.
constexpr double standard_low = 5e-4, standard_high = 25e-4;

// Strain [-] and stress [Pa] up to the largest stress.
struct Curve {
  std::span<const double> strain, stress;

  [[nodiscard]] Line robust(RowRange r) const {
    const auto x = strain.subspan(r.first, r.rows()), y = stress.subspan(r.first, r.rows());
    return with_true_error(fit_robust_line(x, y), x, y);
  }
};

// (X3) Rows between two stresses on the way up: noise may cross a stress several times.
RowRange between(std::span<const double> stress, double low, double high) {
  const auto above = std::ranges::find_if(stress, [&](double s) { return s > high; });
  const auto last = static_cast<std::size_t>(above - stress.begin());
  std::size_t first = last;
  while (first > 0 && stress[first - 1] >= low) --first;
  return {first, last};
}

// How the slopes of a window's lower and upper part compare.
struct Bend {
  bool known = false;
  Line lower, upper;

  // What noise explains of the difference of the slopes.
  [[nodiscard]] double noise() const {
    return 3.0 * std::hypot(lower.slope_standard_error, upper.slope_standard_error);
  }
  // (X5) What it does not.
  [[nodiscard]] double curvature() const {
    const double difference = upper.slope - lower.slope;
    return std::sqrt(std::max(0.0, difference * difference - noise() * noise()));
  }
  [[nodiscard]] bool stiffens() const { return known && lower.slope < upper.slope; }

  // (X5) Up to noise and the curvature that is accepted.
  [[nodiscard]] bool is_straight(double tolerance) const {
    if (!known) return true;
    const double larger = std::max(std::abs(lower.slope), std::abs(upper.slope));
    return std::abs(upper.slope - lower.slope) <= std::max(tolerance * larger, noise());
  }
};

// Slopes from `low` to `middle` and from there to `high` [Pa]; not known where either part has too
// few rows.
Bend bend_at(const Curve& curve, double low, double middle, double high) {
  const RowRange whole = between(curve.stress, low, high);
  const RowRange upper = between(curve.stress, middle, high);
  const RowRange lower{whole.first, upper.first};
  if (lower.rows() < fewest_half_window || upper.rows() < fewest_half_window) return {};
  return {true, curve.robust(lower), curve.robust(upper)};
}

Bend bend_of(const Curve& curve, double low, double high) {
  return bend_at(curve, low, 0.5 * (low + high), high);
}

// How often the slope along the curve swings by more than curvature and noise explain: a toe makes
// it rise, yielding fall, a slip in the grips fall and rise again; waves do so again and again.
int swings_along(const Curve& curve, RowRange rows) {
  constexpr std::size_t most_parts = 16;
  constexpr double curvature = 0.15, errors = 4.0;
  const std::size_t parts = std::min(most_parts, rows.rows() / fewest_half_window);
  const auto part = [&](std::size_t k) {
    return curve.robust(
        {rows.first + k * rows.rows() / parts, rows.first + (k + 1) * rows.rows() / parts});
  };
  // Each slope is compared with the extreme of the swing that goes on, so that noise about that
  // extreme does not count as a swing.
  int swings = 0;
  double direction = 0.0;
  Line extreme;  // of the swing that goes on
  for (std::size_t k = 0; k < parts; ++k) {
    const Line now = part(k);
    if (k == 0) extreme = now;
    const double change = now.slope - extreme.slope;
    const double noise = std::hypot(now.slope_standard_error, extreme.slope_standard_error);
    const double larger = std::max(std::abs(now.slope), std::abs(extreme.slope));
    if (change * direction > 0.0) {
      extreme = now;
    } else if (std::abs(change) > std::max(curvature * larger, errors * noise)) {
      extreme = now;
      direction = change;
      ++swings;
    }
  }
  return swings;
}

// The window in stress, and whether what is left of it is straight.
struct Window {
  double low = 0.0, high = 0.0;  // [Pa]
  Bend bend;                     // Where few rows are left: of the last window that had enough.
  bool straight = false;
  bool told = true;  // False: narrowed until too few rows were left to tell a bend.
};

// (X5) A toe is softer than what follows: the lower end moves up. Yielding is much softer than what
// came before: the upper end moves down. A slope that only fades is neither, and narrowing would
// pick a number at will.
Window straight_window(const Curve& curve, double strength, const ReductionOptions& options) {
  Window window{options.window_low * strength, options.window_high * strength, {}, false};
  const double full = window.high - window.low;
  const Bend whole = bend_of(curve, window.low, window.high);
  const bool yields = whole.known && whole.upper.slope < yielded * whole.lower.slope;
  while (window.high - window.low >= fewest_remaining * full) {
    const Bend bend = bend_of(curve, window.low, window.high);
    if (bend.known) window.bend = bend;
    window.told = bend.known || !whole.known;
    window.straight = bend.is_straight(options.straightness);
    const bool toe = bend.stiffens();
    if (window.straight || (!toe && !yields)) break;
    (toe ? window.low : window.high) += (toe ? 1.0 : -1.0) * narrowing_step * full;
  }
  if (!window.straight)  // nothing is gained by a part of it
    return {options.window_low * strength, options.window_high * strength, whole, false};
  return window;
}

// (X5) A toe too gentle for the halves of a window to show it: what follows is straight, steeper.
Window clear_of_toe(const Curve& curve, const Window& window, double strength,
                    const ReductionOptions& options) {
  const double high = before_failure * strength;
  const Bend onward = bend_at(curve, window.low, window.high, high);
  const double most = gentle_toe * onward.lower.slope + 3.0 * onward.lower.slope_standard_error;
  const bool gentle = onward.stiffens() && onward.upper.slope < most;
  if (!gentle || onward.is_straight(options.straightness)) return window;
  const Bend bend = bend_of(curve, window.high, high);
  const bool straight = bend.known && bend.is_straight(options.straightness);
  return straight ? Window{window.high, high, bend, true} : window;
}

bool differs(const Window& window, double strength, const ReductionOptions& options) {
  return window.low / strength > options.window_low + 1e-9 ||
         std::abs(window.high / strength - options.window_high) > 1e-9;
}

Correction correction_of(const Window& window, double strength, const ReductionOptions& options) {
  const double low = window.low / strength, high = window.high / strength;
  const bool longer = low <= options.window_low + 1e-9 && high > options.window_high;
  return {"modulus window",
          fmt::format("{} from {:.2g}-{:.2g} to {:.2g}-{:.2g} of the strength{}",
                      longer                       ? "extended"
                      : high > options.window_high ? "moved"
                                                   : "narrowed",
                      options.window_low, options.window_high, low, high,
                      longer        ? ""
                      : window.told ? ", where the curve is straight"
                                    : ", where too few rows are left to tell a bend")};
}

// (X6) The line of ISO 527-1, where it can be one: the curve spans its window, and the line meets
// the strain axis within half the window's length of zero, which that of a yielded curve does not.
bool fit_standard(const Curve& curve, ModulusFit& fit) {
  std::vector<double> x, y;
  for (std::size_t i = 0; i < curve.strain.size(); ++i) {
    if (curve.strain[i] < standard_low || curve.strain[i] > standard_high) continue;
    if (x.empty()) fit.window.first = i;
    fit.window.last = i + 1;
    x.push_back(curve.strain[i]);
    y.push_back(curve.stress[i]);
  }
  const Line plain = with_true_error(fit_plain_line(x, y), x, y);
  const Line robust = fit_robust_line(x, y);
  const bool spanned = curve.strain.back() >= standard_high;
  if (!spanned || x.size() < 2 * fewest_half_window || plain.slope <= 0.0) return false;
  const double half = 0.5 * (standard_high - standard_low);
  if (std::abs(plain.intercept / plain.slope) > half) return false;
  fit.line = plain;
  // Two ways to draw a line through a bend differ by more than the noise: that is its uncertainty.
  fit.line.slope_standard_error =
      std::hypot(plain.slope_standard_error, plain.slope - robust.slope);
  return true;
}

// (X4) Noise of the strain flattens the slope by its part of the strain's variance, of which means
// of rows keep less.
void steepen(const Curve& curve, RowRange window, Line& line) {
  // Part of the variance that may count as noise: it keeps the factor below finite.
  constexpr double most = 0.5;
  const auto strain = curve.strain.subspan(window.first, window.rows());
  if (!line.fitted || strain.size() < 2) return;
  const double mean = gsl_stats_mean(strain.data(), 1, strain.size());
  const double variance = gsl_stats_variance_m(strain.data(), 1, strain.size(), mean);
  const double noise = noise_of(curve.strain);
  const double part = std::min(noise * noise / variance, most);
  const auto rows = static_cast<double>(rows_per_point(strain.size()));
  const double factor = 1.0 + part / (1.0 - part) / rows;
  line.intercept -= (factor - 1.0) * line.slope * mean;
  line.slope *= factor;
  line.slope_standard_error *= factor;
}

void fall_back(const Curve& curve, const Window& window, ModulusFit& fit) {
  const std::string complaint = fmt::format(
      "the curve has no straight part between {:.4g} and {:.4g} MPa (its slope goes from {:.4g} "
      "to {:.4g} GPa)",
      window.low * 1e-6, window.high * 1e-6, window.bend.lower.slope * 1e-9,
      window.bend.upper.slope * 1e-9);
  ModulusFit standard;
  if (fit_standard(curve, standard)) {
    fit.line = standard.line;
    fit.window = standard.window;
    fit.warnings.push_back(fmt::format(
        "{}: the modulus is the least-squares slope between {:.3g} and {:.3g} % strain, as in "
        "ISO 527-1, and its standard error the difference to the robust slope there",
        complaint, standard_low * 100, standard_high * 100));
  } else {
    fit.warnings.push_back(complaint + ": the modulus is a mean slope");
  }
}

// (X5), (X24) The line over all the loading where waves run through it: beneath the one that is
// told, or the mean slope over many. None where there are no waves.
std::optional<ModulusFit> fit_through_waves(const Curve& curve, const Window& all) {
  ModulusFit fit{.window = between(curve.stress, all.low, all.high)};
  const auto x = curve.strain.subspan(fit.window.first, fit.window.rows());
  const auto y = curve.stress.subspan(fit.window.first, fit.window.rows());
  if (const std::optional<CarriedWave> wave = find_damped_wave(x, y)) {
    fit.line = wave->line;
    fit.warnings.push_back(
        fmt::format("the stress carries a damped wave, {:.1f} periods of it up to {:.4g} MPa and "
                    "{:.2g} MPa at first, as where a load cell rings: the modulus is the slope "
                    "beneath it",
                    wave->periods, all.high * 1e-6, wave->amplitude * 1e-6));
    return fit;
  }
  if (swings_along(curve, fit.window) < waves) return {};
  fit.line = curve.robust(fit.window);
  fit.warnings.emplace_back(
      "the slope of the curve falls and rises again and again, as where waves run through the "
      "specimen or the load cell: the modulus is the mean slope over more of them");
  return fit;
}

}  // namespace

ModulusFit fit_modulus(std::span<const double> strain, std::span<const double> stress,
                       double strength, const ReductionOptions& options) {
  const Curve curve{strain, stress};
  const Window all{options.window_low * strength,
                   std::max(options.window_high, before_failure) * strength,
                   {},
                   true};
  // Waves first: a window on one flank of a wave is straight, and steep.
  std::optional<ModulusFit> waved = fit_through_waves(curve, all);
  const Window window =
      waved ? all
            : clear_of_toe(curve, straight_window(curve, strength, options), strength, options);
  ModulusFit fit = std::move(waved).value_or(ModulusFit{});
  if (!fit.line.fitted) {
    fit.window = between(stress, window.low, window.high);
    fit.line = curve.robust(fit.window);
  }
  // (X5) The curvature that was accepted is an error too. It is 0 for waves, whose bend is not
  // known.
  if (window.straight) {
    steepen(curve, fit.window, fit.line);
    fit.line.slope_standard_error =
        std::hypot(fit.line.slope_standard_error, window.bend.curvature());
  } else {
    fall_back(curve, window, fit);
  }
  if (differs(window, strength, options))
    fit.corrections.push_back(correction_of(window, strength, options));
  return fit;
}

}  // namespace havers::calib
