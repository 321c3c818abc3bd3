// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtWidgets/QLineEdit>

class QPlcPanelContext;

namespace qplc {

class PlantList;

/// A line for the name of a signal, which offers all signals that have what was typed somewhere in
/// their names.
class SignalEdit : public QLineEdit
{
    Q_OBJECT
public:
    enum Offer {
        AllSignals,  // and the elements of arrays behind them
        Curves       // what a curve can show: numbers, arrays by element; formulas are taken too
    };

    /// \param context  of the panel in which it is, and which outlives it
    explicit SignalEdit(QPlcPanelContext *context, Offer offer = AllSignals, QWidget *parent = nullptr);

    static QStringList names(const PlantList &plants, Offer offer);

Q_SIGNALS:
    /// Enter was pressed, or a name was chosen from the list: it is the text of the line now, and
    /// not empty. What is typed means the first name like it when it is none itself.
    void chosen(const QString &text);
    /// Esc was pressed.
    void left();

protected:
    void keyPressEvent(QKeyEvent *event) override;

private:
    QString meant() const;
    void choose(const QString &name);
};

}  // namespace qplc
