// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtWidgets/QLineEdit>

class QCompleter;

namespace qplc {

class PlantList;

/// A line for the name of a signal, which offers all signals that have what was typed somewhere in their names.
class SignalEdit : public QLineEdit
{
    Q_OBJECT
public:
    /// \param plants  null: nothing is offered
    explicit SignalEdit(PlantList *plants, QWidget *parent = nullptr);

    /// All signals of all plants, and the elements of arrays behind them.
    static QStringList names(const PlantList &plants);

Q_SIGNALS:
    /// A name was chosen from the list, or Enter pressed.
    void chosen(const QString &reference);

private:
    PlantList *m_plants;
};

}  // namespace qplc
