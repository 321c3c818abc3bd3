// SPDX-License-Identifier: Apache-2.0
#include "SignalEdit.h"

#include "gui/plant/PlantList.h"

#include <QtCore/QStringListModel>
#include <QtWidgets/QCompleter>

namespace qplc {

SignalEdit::SignalEdit(PlantList *plants, QWidget *parent)
    : QLineEdit(parent)
    , m_plants(plants)
{
    setPlaceholderText(tr("Name of a signal"));
    setAccessibleName(tr("Signal"));
    setClearButtonEnabled(true);
    connect(this, &QLineEdit::returnPressed, this, [this] { Q_EMIT chosen(text().trimmed()); });
    if (!m_plants)
        return;
    auto *offered = new QStringListModel(names(*m_plants), this);
    auto *completer = new QCompleter(offered, this);
    completer->setFilterMode(Qt::MatchContains);
    completer->setCaseSensitivity(Qt::CaseInsensitive);
    completer->setMaxVisibleItems(12);
    setCompleter(completer);
    connect(completer, QOverload<const QString &>::of(&QCompleter::activated), this, &SignalEdit::chosen);
    connect(m_plants, &PlantList::signalsChanged, this, [this, offered] { offered->setStringList(names(*m_plants)); });
}

QStringList SignalEdit::names(const PlantList &plants)
{
    QStringList names;
    for (int i = 0; i < plants.size(); ++i) {
        const Plant *plant = plants.at(i);
        for (int signal = 0; signal < plant->table().size(); ++signal) {
            const auto index = QPlcSignalIndex(signal);
            names << plants.reference(plant, index).toString();
            const QPlcSignalType type = plant->table().at(index).type;
            for (int element = 0; type.isArray() && element < type.count(); ++element)
                names << plants.reference(plant, index, element).toString();
        }
    }
    return names;
}

}  // namespace qplc
