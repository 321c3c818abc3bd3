// SPDX-License-Identifier: Apache-2.0
#include "ShareSplitter.h"

#include <algorithm>

namespace qplc {

ShareSplitter::ShareSplitter(Qt::Orientation orientation, QWidget *parent)
    : QSplitter(orientation, parent)
{
    setChildrenCollapsible(false);
    setHandleWidth(5);
    connect(this, &QSplitter::splitterMoved, this, [this] { Q_EMIT sharesEdited(m_span, sharesOfSizes()); });
}

void ShareSplitter::showShares(const LayoutSpan &span, const QVector<int> &shares)
{
    m_span = span;
    m_shares = shares;
    apply();
}

QVector<int> ShareSplitter::sharesOfSizes() const
{
    QVector<double> weights;
    for (int size : sizes())
        weights.append(std::max(size, 1));
    return layoutShares(weights);
}

void ShareSplitter::apply()
{
    // Sizes that a hand has just made are right to the pixel: they are not made again from rounded
    // shares.
    if (m_shares.size() != count() || (m_isApplied && sharesOfSizes() == m_shares))
        return;
    setSizes(QList<int>(m_shares.begin(), m_shares.end()));
    m_isApplied = true;
}

}  // namespace qplc
