// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/panel/SettingsEditor.h"

#include <QtCore/QVector>

class QCheckBox;
class QVBoxLayout;

namespace qplc {

/// The settings of an XY plot, as the toothed wheel shows them: a line with x and y for each curve,
/// and what the axes do. What is changed is told at once.
class XyPlotEditor : public SettingsEditor
{
    Q_OBJECT
public:
    struct Expressions
    {
        QString x;
        QString y;
    };

    XyPlotEditor(const QVector<Expressions> &curves, bool isEqual, QWidget *parent = nullptr);

Q_SIGNALS:
    void expressionChanged(int curve, const QString &x, const QString &y);
    void curveRemoved(int curve);
    void curveAdded();
    void equalAspectChanged(bool isEqual);

private:
    void addRow(const Expressions &expressions);
    void removeRow(QWidget *row);

    QVBoxLayout *m_rows;
};

}  // namespace qplc
