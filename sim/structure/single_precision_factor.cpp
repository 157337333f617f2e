// Half a solve reads the values panel by panel, in one direction, and half as many bytes as doubles
// have. The inverse of a strip's own square takes the place of a substitution, in which each column
// waits for the one before.
#include "sim/structure/single_precision_factor.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <iterator>
#include <type_traits>
#include <utility>

#include "sim/memory.hpp"

namespace havers::sim {

using Eigen::Index;
using Eigen::VectorXd;
using Eigen::VectorXf;

namespace {

constexpr int widest = 16;  // columns of a strip

constexpr int width_of(int columns) {
  return columns > 8 ? widest : columns > 4 ? 8 : 4;
}

// The width of a strip as a constant.
template <class Call>
void with_width(int columns, Call call) {
  if (columns > 8)
    call(std::integral_constant<int, widest>());
  else if (columns > 4)
    call(std::integral_constant<int, 8>());
  else
    call(std::integral_constant<int, 4>());
}

template <int width>
using Row = Eigen::Array<float, width, 1>;

template <int width>
Eigen::Map<const Row<width>, Eigen::Aligned16> row(const float* values, int i) {
  return Eigen::Map<const Row<width>, Eigen::Aligned16>(values + i * width);
}

// Of all rows, weighted. One after the other: where a part moves as a whole neighbours cancel
// before their sum grows and is rounded. From the last on, as strips are: memory is read in one
// direction.
template <int width, class Weight>
Row<width> sum_of_rows(const float* values, int rows, const Weight& weight) {
  Row<width> sum = Row<width>::Zero();
  for (int i = rows; i-- > 0;) {
    const float by = weight(i);
    for (int k = 0; k < width; ++k) sum[k] += by * values[i * width + k];
  }
  return sum;
}

}  // namespace

SinglePrecisionFactor::SinglePrecisionFactor(const SparseFactor& factor)
    : tree_(factor.tree_), inverse_pivots_(factor.inverse_pivots_) {
  lay_out();
  for (const Panel& panel : tree_->panels)
    if (tree_->is_first(panel))
      copy<double>(panel, {factor.values_.data() + panel.values, static_cast<Index>(panel.height),
                           panel.columns});
}

SinglePrecisionFactor::SinglePrecisionFactor(const ElementMatrices& A,
                                             std::shared_ptr<const EliminationTree> tree,
                                             const Pivots& pivots)
    : tree_(std::move(tree)) {
  lay_out();
  using Panels = PanelStore<float>::Panels;
  // One panel at a time is found here, and copied to its strips.
  Eigen::MatrixXf at_work;
  inverse_pivots_ =
      factorise<float>(A, *tree_, pivots,
                       {[&](const Panel& panel) {
                          at_work.setZero(static_cast<Index>(panel.height), panel.columns);
                          return Panels(at_work.data(), at_work.rows(), at_work.cols());
                        },
                        [&](const Panel& panel, const Panels& found) {
                          copy<float>(panel, {found.data(), found.rows(), found.cols()});
                        }});
}

void SinglePrecisionFactor::lay_out() {
  std::size_t size = 0;
  std::vector<std::size_t> values(tree_->panels.size());  // of each panel
  for (const Panel& panel : tree_->panels) {
    first_strip_.push_back(strips_.size());
    const bool is_first = tree_->is_first(panel);
    const auto like = static_cast<std::size_t>(panel.like);
    if (is_first) values[like] = size;
    std::size_t at = values[like];
    for (int first = 0, columns = 0; first < panel.columns; first += columns) {
      // Nine to twelve columns become strips of 8 and 4, which take less filling up than 16.
      const int left = panel.columns - first;
      columns = left > 12 ? std::min(left, widest) : std::min(left, 8);
      const auto before = static_cast<std::size_t>(first);
      const auto height = panel.height - before;
      strips_.push_back({panel.at + before, static_cast<int>(height), columns, at});
      at += height * static_cast<std::size_t>(width_of(columns));
    }
    if (is_first) size = at;
  }
  first_strip_.push_back(strips_.size());
  values_.reserve(size);
  ask_for_large_pages(values_.data(), size * sizeof(float));
  values_.assign(size, 0.0F);
}

template <class Scalar>
void SinglePrecisionFactor::copy(const Panel& panel,
                                 const Eigen::Map<const Eigen::MatrixX<Scalar>>& from) {
  std::size_t next = first_strip_[static_cast<std::size_t>(&panel - tree_->panels.data())];
  for (Index first = 0; first < from.cols(); ++next) {
    const Strip& strip = strips_[next];
    const Index columns = strip.columns;
    // By rows; what fills a strip up stays zero.
    Eigen::Map<Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> to(
        values_.data() + strip.values, strip.height, width_of(strip.columns));
    // The inverse of the strip's own square, in the precision of what it is made of.
    to.topLeftCorner(columns, columns) =
        from.block(first, first, columns, columns)
            .template triangularView<Eigen::UnitLower>()
            .solve(Eigen::MatrixX<Scalar>::Identity(columns, columns))
            .template cast<float>();
    first += columns;
    to.bottomRows(strip.height - columns).leftCols(columns) =
        from.bottomRows(from.rows() - first)
            .middleCols(first - columns, columns)
            .template cast<float>();
  }
}

// x ← L⁻¹ x on the rows of a strip. What is read beyond its own columns counts with zeros; x ends
// with as many more as that may be.
void SinglePrecisionFactor::eliminate(const Strip& strip, VectorXf& x) const {
  with_width(strip.columns, [&](auto width) {
    const float* const values = values_.data() + strip.values;
    const int* const rows = tree_->rows.data() + strip.rows;
    const auto all = x.segment<width>(*rows).array();
    Row<width> known = all;
    // The strip's own rows at once, by the inverse of its square.
    for (int i = 0; i < strip.columns; ++i) x(*rows + i) = (row<width>(values, i) * known).sum();
    known = all;
    // Then what these take from the rows below.
    for (int i = strip.columns; i < strip.height; ++i)
      x(rows[i]) -= (row<width>(values, i) * known).sum();
  });
}

// x ← L⁻ᵀ x, likewise.
void SinglePrecisionFactor::substitute(VectorXf& x) const {
  for (std::size_t i = strips_.size(); i-- > 0;) {
    const Strip& strip = strips_[i];
    with_width(strip.columns, [&](auto width) {
      const float* const values = values_.data() + strip.values;
      const int* const rows = tree_->rows.data() + strip.rows;
      const int* const below = rows + strip.columns;
      Row<width> left = x.segment<width>(*rows).array();
      left -= sum_of_rows<width>(values + strip.columns * width, strip.height - strip.columns,
                                 [&](int k) { return x(below[k]); });
      const auto weight = [&](int column) { return left(column); };
      const Row<width> own = sum_of_rows<width>(values, strip.columns, weight);
      for (int column = 0; column < strip.columns; ++column) x(*rows + column) = own(column);
    });
  }
}

VectorXf SinglePrecisionFactor::halve(const VectorXd& b) const {
  assert(ok());
  // Strips at the end may read beyond it, by the widest one at most.
  VectorXf x(b.size() + widest);
  x.tail<widest>().setZero();
  x(tree_->place) = b.cast<float>();
  for (const Strip& strip : strips_) eliminate(strip, x);
  return x.head(b.size());
}

VectorXf SinglePrecisionFactor::complete(const Eigen::Ref<const VectorXd>& half) const {
  assert(ok());
  VectorXf x(half.size() + widest);
  x.tail<widest>().setZero();
  x.head(half.size()) = inverse_pivots_.cwiseProduct(half).cast<float>();
  substitute(x);
  return x(tree_->place);
}

Eliminated SinglePrecisionFactor::eliminate(std::vector<int> rows,
                                            const Eigen::MatrixX2d& values) const {
  assert(ok());
  // A vector for each load, as strips work on one.
  std::array<VectorXf, 2> x;
  for (int& row : rows) row = tree_->place[static_cast<std::size_t>(row)];
  for (const std::size_t load : {0U, 1U}) {
    x[load].setZero(inverse_pivots_.size() + widest);
    x[load](rows) = values.col(static_cast<Index>(load)).cast<float>();
  }
  Eliminated half;
  const int first = *std::ranges::min_element(rows);
  // Only the path from the first of the rows to the root is looked at, as in SparseFactor.
  for (const Panel* panel = &tree_->panel_of(first); panel != nullptr;
       panel = tree_->parent_of(*panel)) {
    const auto p = static_cast<std::size_t>(panel - tree_->panels.data());
    for (std::size_t strip = first_strip_[p]; strip < first_strip_[p + 1]; ++strip)
      for (VectorXf& load : x) eliminate(strips_[strip], load);
    for (int row = std::max(panel->first, first); row < panel->first + panel->columns; ++row)
      half.rows.push_back(row);
  }
  half.values.resize(2, std::ssize(half.rows));
  for (const std::size_t load : {0U, 1U})
    half.values.row(static_cast<Index>(load)) = x[load](half.rows).transpose().cast<double>();
  return half;
}

Eliminated SinglePrecisionFactor::over_pivots(Eliminated half) const {
  half.values = half.values * inverse_pivots_(half.rows).asDiagonal();
  return half;
}

}  // namespace havers::sim
