// SPDX-License-Identifier: Apache-2.0
#include "SignalEdit.h"

#include "gui/plant/PlantList.h"

#include <QtGui/QKeyEvent>
#include <QtWidgets/QAbstractItemView>
#include <QtWidgets/QCompleter>

namespace qplc {

SignalEdit::SignalEdit(const PlantList *plants, QWidget *parent)
    : QLineEdit(parent)
{
    setPlaceholderText(tr("Signal, or = formula"));
    setAccessibleName(tr("Name of a signal"));
    setClearButtonEnabled(true);
    if (!plants)
        return;
    auto *completer = new QCompleter(namesOf(*plants), this);
    completer->setFilterMode(Qt::MatchContains);
    completer->setCaseSensitivity(Qt::CaseInsensitive);
    completer->setMaxVisibleItems(12);
    setCompleter(completer);
    // Later, for the completer writes the name into the line after it has told it.
    connect(
        completer, QOverload<const QString &>::of(&QCompleter::activated), this,
        [this](const QString &text) { choose(text); }, Qt::QueuedConnection);
}

QStringList SignalEdit::namesOf(const PlantList &plants)
{
    QStringList names;
    for (int i = 0; i < plants.size(); ++i) {
        const QPlcSignalTable &table = plants.at(i)->table();
        for (QPlcSignalIndex signal = 0; signal < table.size(); ++signal) {
            const QPlcSignalType type = table.at(signal).type;
            const bool isArray = type.isNumeric() && type.isArray();
            for (int element = 0; isArray && element < type.count(); ++element)
                names << plants.reference(plants.at(i), signal, element).toString();
            if (type.isNumeric() && !isArray)
                names << plants.reference(plants.at(i), signal).toString();
        }
    }
    return names;
}

void SignalEdit::keyPressEvent(QKeyEvent *event)
{
    if (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter)
        choose(meant());
    else if (event->key() == Qt::Key_Escape)
        Q_EMIT left();
    else
        QLineEdit::keyPressEvent(event);
}

/// What is written when it is a formula, the name of a signal, or like none; else the first name like it.
QString SignalEdit::meant() const
{
    const QString written = text().trimmed();
    QCompleter *names = completer();
    if (!names || written.isEmpty() || written.startsWith(QLatin1Char('=')))
        return written;
    names->setCompletionPrefix(written);
    QString first;
    for (int i = 0; names->setCurrentRow(i); ++i) {
        if (names->currentCompletion() == written)
            return written;
        if (i == 0)
            first = names->currentCompletion();
    }
    return first.isEmpty() ? written : first;
}

void SignalEdit::choose(const QString &name)
{
    if (name.isEmpty())
        return;
    if (completer())
        completer()->popup()->hide();
    clear();
    Q_EMIT chosen(name);
}

}  // namespace qplc
