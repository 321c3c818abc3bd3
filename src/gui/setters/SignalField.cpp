// SPDX-License-Identifier: Apache-2.0
#include "SignalField.h"

#include "gui/plant/PlantList.h"

#include <QtWidgets/QCompleter>
#include <QtWidgets/QLineEdit>

namespace qplc {

QLineEdit *createSignalField(const PlantList *plants, QWidget *parent)
{
    QStringList names;
    for (int i = 0; plants && i < plants->size(); ++i) {
        const Plant *plant = plants->at(i);
        for (QPlcSignalIndex signal = 0; signal < plant->table().size(); ++signal)
            names << plants->reference(plant, signal).toString();
    }
    auto *field = new QLineEdit(parent);
    auto *completer = new QCompleter(names, field);
    completer->setCaseSensitivity(Qt::CaseInsensitive);
    completer->setFilterMode(Qt::MatchContains);
    field->setCompleter(completer);
    field->setPlaceholderText(QLineEdit::tr("signal"));
    field->setAccessibleName(QLineEdit::tr("Signal"));
    return field;
}

}  // namespace qplc
