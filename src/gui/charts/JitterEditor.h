// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtWidgets/QWidget>

namespace qplc {

/// The settings of a jitter histogram, as the toothed wheel shows them. What is changed is told at
/// once.
class JitterEditor : public QWidget
{
    Q_OBJECT
public:
    /// \param keys  of all that can be shown (JitterDistribution::key())
    JitterEditor(const QStringList &keys, const QStringList &shown, bool isLast, QWidget *parent = nullptr);
    /// Offers a choice of plants above all else. \param plant of these; empty: the first one,
    /// whichever it is
    void addPlants(const QStringList &plants, const QString &plant);

Q_SIGNALS:
    void shownChanged(const QString &key, bool isShown);
    void lastChanged(bool isLast);
    void plantChanged(const QString &plant);
};

}  // namespace qplc
