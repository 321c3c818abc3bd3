// SPDX-License-Identifier: Apache-2.0
#include "SignalEdit.h"

#include "QPlcPanelContext.h"
#include "gui/plant/PlantList.h"

#include <QtCore/QMetaMethod>
#include <QtCore/QStringListModel>
#include <QtGui/QKeyEvent>
#include <QtWidgets/QAbstractItemView>
#include <QtWidgets/QCompleter>

namespace qplc {

SignalEdit::SignalEdit(QPlcPanelContext *context, Offer offer, QWidget *parent)
    : QLineEdit(parent)
{
    setPlaceholderText(offer == Curves ? tr("Signal, or = formula") : tr("Name of a signal"));
    setAccessibleName(tr("Name of a signal"));
    setClearButtonEnabled(true);
    const auto names = [context, offer] { return offer == Curves ? context->numberNames() : context->signalNames(); };
    auto *offered = new QStringListModel(names(), this);
    auto *completer = new QCompleter(offered, this);
    completer->setFilterMode(Qt::MatchContains);
    completer->setCaseSensitivity(Qt::CaseInsensitive);
    completer->setMaxVisibleItems(12);
    setCompleter(completer);
    // Later, for the completer writes the name into the line after it has told it.
    connect(
        completer, QOverload<const QString &>::of(&QCompleter::activated), this,
        [this](const QString &text) { choose(text); }, Qt::QueuedConnection);
    connect(context, &QPlcPanelContext::signalsChanged, this, [offered, names] { offered->setStringList(names()); });
}

QStringList SignalEdit::names(const PlantList &plants, Offer offer)
{
    QStringList names;
    for (const Plant *plant : plants.all()) {
        const QPlcSignalTable &table = plant->table();
        for (int place = 0; place < table.size(); ++place) {
            const auto signal = QPlcSignalIndex(place);
            const QPlcSignalType type = table.at(signal).type;
            if (offer == AllSignals || (type.isNumeric() && !type.isArray()))
                names << plants.reference(plant, signal).toString();
            const bool hasElements = type.isArray() && (offer == AllSignals || type.isNumeric());
            for (int element = 0; hasElements && element < type.count(); ++element)
                names << plants.reference(plant, signal, element).toString();
        }
    }
    return names;
}

void SignalEdit::keyPressEvent(QKeyEvent *event)
{
    if (event->key() == Qt::Key_Escape) {
        // Without a listener the key is for others: it closes the settings around this line.
        event->setAccepted(isSignalConnected(QMetaMethod::fromSignal(&SignalEdit::left)));
        Q_EMIT left();
        return;
    }
    const bool isEnter = event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter;
    if (isEnter)
        choose(meant());
    QLineEdit::keyPressEvent(event);
    if (isEnter)
        event->accept();  // of no use to who is behind
}

/// What is written when it is a formula, the name of a signal, or like none; else the first name
/// like it.
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
    setText(name);
    Q_EMIT chosen(name);
}

}  // namespace qplc
