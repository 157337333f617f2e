// Dense kernels of the panels. Widths are known at compile time, so that sums may stay in
// registers; a block of columns acts on those behind it as one product.
#include "sim/structure/panel.hpp"

#include <algorithm>

namespace havers::sim {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Ref;

namespace {

constexpr Index in_block = 32;  // columns that are taken from those behind them as one product

// x ← L⁻¹ x by so many columns from `first` on: in their own rows first, then in all rows below at
// once.
template <Index columns>
void eliminate(const Ref<const MatrixXd>& panel, Index first, Ref<MatrixXd>& x) {
  const Index below = panel.rows() - first - columns;
  for (Index c = 0; c < x.cols(); ++c) {
    Eigen::Matrix<double, columns, 1> own = x.col(c).segment<columns>(first);
    for (Index j = 0; j < columns; ++j)
      for (Index i = j + 1; i < columns; ++i) own(i) -= panel(first + i, first + j) * own(j);
    x.col(c).segment<columns>(first) = own;
    x.col(c).tail(below).noalias() -=
        panel.block<Eigen::Dynamic, columns>(first + columns, first, below, columns)
            .lazyProduct(own);
  }
}

// The sums of all columns and loads side by side, as many terms of each at a time as a register of
// 16 bytes holds. What rows far apart add is large where a part moves as a whole, and cancels: sums
// of few rows are taken from what is left before they grow.
template <Index columns, Index loads>
void substitute(const Ref<const MatrixXd>& panel, Index first, Index load, Ref<MatrixXd>& x) {
  constexpr Index terms = 2, at_once = 16;
  using Terms = Eigen::Map<const Eigen::Vector2d>;
  const auto of = panel.middleCols<columns>(first);
  auto known = x.middleCols<loads>(load);
  Eigen::Matrix<double, columns, loads> left = known.template middleRows<columns>(first);
  Index i = panel.rows();
  while (i - terms >= first + columns) {
    const Index last = std::max(i - at_once, first + columns);
    Eigen::Matrix<double, terms, columns * loads> sums;
    sums.setZero();
    for (; i - terms >= last; i -= terms)
      for (Index j = 0; j < columns; ++j)
        for (Index c = 0; c < loads; ++c)
          sums.col(j + columns * c) +=
              Terms(&of.coeffRef(i - terms, j)).cwiseProduct(Terms(&known.coeffRef(i - terms, c)));
    left -= sums.colwise().sum().reshaped(columns, loads);
  }
  for (Index row = first + columns; row < i; ++row)
    left.noalias() -= of.row(row).transpose() * known.row(row);
  for (Index c = 0; c < loads; ++c) {
    auto own = left.col(c);
    for (Index j = columns - 1; j >= 0; --j)
      for (Index k = j + 1; k < columns; ++k) own(j) -= of(first + k, j) * own(k);
  }
  known.template middleRows<columns>(first) = left;
}

// Two loads at a time share what is read of the panel.
template <Index columns>
void substitute_all(const Ref<const MatrixXd>& panel, Index first, Ref<MatrixXd>& x) {
  Index c = 0;
  for (; c + 2 <= x.cols(); c += 2) substitute<columns, 2>(panel, first, c, x);
  if (c < x.cols()) substitute<columns, 1>(panel, first, c, x);
}

}  // namespace

template <class Scalar>
void factorise_panel(Ref<Eigen::MatrixX<Scalar>> panel) {
  Eigen::MatrixX<Scalar> scaled;
  for (Index begin = 0; begin < panel.cols(); begin += in_block) {
    // Within the block each column is taken from those behind it.
    const Index end = std::min(begin + in_block, panel.cols());
    for (Index j = begin; j < end; ++j) {
      const Scalar pivot = panel(j, j);
      for (Index k = j + 1; k < end; ++k)
        panel.col(k).tail(panel.rows() - k) -=
            panel(k, j) / pivot * panel.col(j).tail(panel.rows() - k);
      panel.col(j).tail(panel.rows() - j - 1) /= pivot;
    }
    // Then the block is taken from all columns behind it, as one product.
    const auto block = panel.bottomRows(panel.rows() - end).middleCols(begin, end - begin);
    const Index left = panel.cols() - end;
    scaled.noalias() =
        block.topRows(left) * panel.diagonal().segment(begin, end - begin).asDiagonal();
    panel.bottomRightCorner(panel.rows() - end, left).noalias() -= block * scaled.transpose();
  }
}

template <class Scalar>
void take_panel_from(Ref<Eigen::MatrixX<Scalar>> rest,
                     const Ref<const Eigen::MatrixX<Scalar>>& panel) {
  const auto below = panel.bottomRows(rest.rows());
  rest.template triangularView<Eigen::Lower>() -=
      below * panel.diagonal().asDiagonal() * below.transpose();
}

template void factorise_panel<double>(Ref<MatrixXd>);
template void factorise_panel<float>(Ref<Eigen::MatrixXf>);
template void take_panel_from<double>(Ref<MatrixXd>, const Ref<const MatrixXd>&);
template void take_panel_from<float>(Ref<Eigen::MatrixXf>, const Ref<const Eigen::MatrixXf>&);

void eliminate_panel(const Ref<const MatrixXd>& panel, Index first, Ref<MatrixXd> x) {
  for (; first + 4 <= panel.cols(); first += 4) eliminate<4>(panel, first, x);
  for (; first < panel.cols(); ++first) eliminate<1>(panel, first, x);
}

void substitute_panel(const Ref<const MatrixXd>& panel, Ref<MatrixXd> x) {
  // From the last column on: first those that do not fill a group.
  Index first = panel.cols();
  for (; first % 4 != 0; --first) substitute_all<1>(panel, first - 1, x);
  for (; first > 0; first -= 4) substitute_all<4>(panel, first - 4, x);
}

}  // namespace havers::sim
