// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "LayoutNode.h"

#include <QtWidgets/QSplitter>

namespace qplc {

/// A splitter that is told and tells the shares of its parts; QSplitter itself keeps them whatever
/// its size.
class ShareSplitter : public QSplitter
{
    Q_OBJECT
public:
    explicit ShareSplitter(Qt::Orientation orientation, QWidget *parent = nullptr);

    /// \param span  the split that is shown, by which edits name it
    void showShares(const LayoutSpan &span, const QVector<int> &shares);

Q_SIGNALS:
    /// A person has moved a handle.
    void sharesEdited(const qplc::LayoutSpan &span, const QVector<int> &shares);

private:
    QVector<int> sharesOfSizes() const;
    void apply();

    LayoutSpan m_span;
    QVector<int> m_shares;
    bool m_isApplied = false;  // else sizes follow the hints of the parts as soon as the splitter is shown
};

}  // namespace qplc
