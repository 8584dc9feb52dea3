// SPDX-License-Identifier: Apache-2.0
#include "SparseCholesky.h"

#include "Errors.h"

#include <cholmod.h>

#include <algorithm>

namespace surgicalmesher
{
namespace
{

using Order = std::vector<int>;

/// CHOLMOD's view of a matrix, without a copy; the matrix must outlive it.
cholmod_sparse viewOf(const SymmetricMatrix& matrix)
{
  cholmod_sparse view{};
  view.nrow = view.ncol = std::size_t(matrix.rows());
  view.nzmax = std::size_t(matrix.nonZeros());
  view.p = const_cast<int*>(matrix.outerIndexPtr());
  view.i = const_cast<int*>(matrix.innerIndexPtr());
  view.x = const_cast<double*>(matrix.valuePtr());
  view.stype = -1; // lower
  view.itype = CHOLMOD_INT;
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = view.packed = 1;
  return view;
}

cholmod_dense viewOf(const Eigen::Ref<const Eigen::MatrixXd>& matrix)
{
  cholmod_dense view{};
  view.nrow = std::size_t(matrix.rows());
  view.ncol = std::size_t(matrix.cols());
  view.d = std::size_t(matrix.outerStride());
  view.nzmax = view.d * view.ncol;
  view.x = const_cast<double*>(matrix.data());
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  return view;
}

/// Returns all unknowns except `last`, ascending.
Order others(Eigen::Index size, const std::vector<std::int32_t>& last)
{
  std::vector<bool> isLast(std::size_t(size), false);
  for (const std::int32_t u : last) isLast[std::size_t(u)] = true;
  Order result;
  for (int u = 0; u < size; ++u)
    if (!isLast[std::size_t(u)]) result.push_back(u);
  return result;
}

/// Returns the submatrix of the rows and columns `kept` (ascending).
SymmetricMatrix submatrix(const SymmetricMatrix& matrix, const Order& kept)
{
  std::vector<int> number(std::size_t(matrix.rows()), -1);
  for (std::size_t k = 0; k < kept.size(); ++k) number[std::size_t(kept[k])] = int(k);
  std::vector<Eigen::Triplet<double>> entries;
  for (const int column : kept)
    for (SymmetricMatrix::InnerIterator entry(matrix, column); entry; ++entry)
      if (number[std::size_t(entry.row())] >= 0)
        entries.emplace_back(number[std::size_t(entry.row())], number[std::size_t(column)], entry.value());
  SymmetricMatrix result(Eigen::Index(kept.size()), Eigen::Index(kept.size()));
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

} // namespace

struct SparseCholesky::Private
{
  cholmod_common common{};
  cholmod_factor* factor = nullptr;
  std::size_t last = 0;

  Private()
  {
    cholmod_start(&common);
    common.supernodal = CHOLMOD_SUPERNODAL;
    common.print = 0;
  }
  ~Private()
  {
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }

  void requireMemory() const
  {
    if (common.status == CHOLMOD_OUT_OF_MEMORY || common.status == CHOLMOD_TOO_LARGE)
      throw EngineError("out of memory at the factor of the stiffness matrix");
  }

  /// Returns a fill-reducing order.
  Order fillReducing(const SymmetricMatrix& pattern)
  {
    cholmod_sparse view = viewOf(pattern);
    cholmod_factor* analyzed = cholmod_analyze(&view, &common);
    requireMemory();
    const int* order = static_cast<const int*>(analyzed->Perm);
    Order result(order, order + pattern.rows());
    cholmod_free_factor(&analyzed, &common);
    return result;
  }

  /// Analyses with the given order. Postordering is off, as it would move other unknowns between or behind the last
  /// ones.
  void analyze(const SymmetricMatrix& pattern, Order& order)
  {
    cholmod_sparse view = viewOf(pattern);
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_GIVEN;
    common.postorder = 0;
    factor = cholmod_analyze_p(&view, order.data(), nullptr, 0, &common);
    requireMemory();
  }
};

SparseCholesky::SparseCholesky(const SymmetricMatrix& pattern, const std::vector<std::int32_t>& last)
  : d(std::make_unique<Private>())
{
  d->last = last.size();
  const Order first = others(pattern.rows(), last);
  Order order;
  if (!first.empty())
    for (const int k : d->fillReducing(submatrix(pattern, first))) order.push_back(first[std::size_t(k)]);
  order.insert(order.end(), last.begin(), last.end());
  d->analyze(pattern, order);
}

SparseCholesky::~SparseCholesky() = default;

bool SparseCholesky::factorize(const SymmetricMatrix& matrix)
{
  cholmod_sparse view = viewOf(matrix);
  cholmod_factorize(&view, d->factor, &d->common);
  d->requireMemory();
  return d->common.status == CHOLMOD_OK;
}

Eigen::MatrixXd SparseCholesky::solve(const Eigen::Ref<const Eigen::MatrixXd>& rightSides) const
{
  cholmod_dense view = viewOf(rightSides);
  cholmod_dense* solution = cholmod_solve(CHOLMOD_A, d->factor, &view, &d->common);
  d->requireMemory();
  Eigen::MatrixXd result =
    Eigen::Map<const Eigen::MatrixXd>(static_cast<const double*>(solution->x), rightSides.rows(), rightSides.cols());
  cholmod_free_dense(&solution, &d->common);
  return result;
}

Eigen::MatrixXd SparseCholesky::condensed() const
{
  const cholmod_factor& L = *d->factor;
  const int *super = static_cast<const int*>(L.super), *rowStart = static_cast<const int*>(L.pi),
            *valueStart = static_cast<const int*>(L.px), *rows = static_cast<const int*>(L.s);
  const double* values = static_cast<const double*>(L.x);
  const int size = int(d->last), begin = int(L.n) - size;
  Eigen::MatrixXd corner = Eigen::MatrixXd::Zero(size, size);
  for (std::size_t s = 0; s < L.nsuper; ++s)
  {
    const int height = rowStart[s + 1] - rowStart[s];
    for (int column = std::max(super[s], begin); column < super[s + 1]; ++column)
    {
      const int within = column - super[s];
      for (int r = within; r < height; ++r) // the upper triangle of a supernode is empty
        corner(rows[rowStart[s] + r] - begin, column - begin) = values[valueStart[s] + r + within * height];
    }
  }
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(size, size);
  result.selfadjointView<Eigen::Lower>().rankUpdate(corner);
  return result.selfadjointView<Eigen::Lower>();
}

std::size_t SparseCholesky::entries() const { return d->factor->xsize; }

} // namespace surgicalmesher
