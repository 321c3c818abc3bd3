// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtWidgets/QLineEdit>

namespace qplc {

class PlantList;

/// A line for the name of a signal, with completion over all signals of all plants, by any part of the name.
class SignalEdit : public QLineEdit
{
    Q_OBJECT
public:
    /// \param plants  null: no completion
    explicit SignalEdit(const PlantList *plants, QWidget *parent = nullptr);

    /// All numbers that can be drawn, as references; arrays by element.
    static QStringList namesOf(const PlantList &plants);

Q_SIGNALS:
    /// Enter was pressed, or a name was chosen from the list; never empty.
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
