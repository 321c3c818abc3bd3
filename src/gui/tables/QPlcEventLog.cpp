// SPDX-License-Identifier: Apache-2.0
#include "QPlcEventLog.h"

#include "PanelTable.h"
#include "QPlcPanelContext.h"
#include "QPlcTimeAxis.h"
#include "SearchLine.h"
#include "gui/models/EventLogModel.h"
#include "gui/panel/PanelAction.h"
#include "gui/panel/PanelSettings.h"

#include <QtWidgets/QAction>
#include <QtWidgets/QComboBox>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QMenu>
#include <QtWidgets/QScrollBar>
#include <QtWidgets/QToolButton>
#include <QtWidgets/QVBoxLayout>

using namespace qplc;

namespace {

const QVector<PanelTable::Column> eventColumns
    = {{"time", 14, true}, {"severity", 13, true}, {"state", 16, true}, {"source", 16, true}, {"event", 40, true}};

const QStringList severities = {QStringLiteral("information"), QStringLiteral("warning"), QStringLiteral("error")};

TableDelegate::Sign signOfEvent(const QModelIndex &index)
{
    const int severity = index.data(EventLogModel::SeverityRole).toInt();
    if (index.column() == EventLogModel::State && index.data(EventLogModel::ActiveRole).toBool())
        return severity == PlantEvent::Error ? TableDelegate::Alarm : TableDelegate::Warning;
    if (index.column() != EventLogModel::Severity)
        return TableDelegate::NoSign;
    if (severity == PlantEvent::Information)
        return TableDelegate::Note;
    if (index.data(EventLogModel::AcknowledgedRole).toBool())
        return TableDelegate::Unknown;
    return severity == PlantEvent::Error ? TableDelegate::Alarm : TableDelegate::Warning;
}

}  // namespace

struct QPlcEventLog::Private
{
    PanelTable *table = nullptr;
    EventFilterModel *filter = nullptr;
    QPlcPanelContext *context = nullptr;  // from contextChanged() on
    QComboBox *severity = nullptr;
    QLineEdit *search = nullptr;
    QAction *onlyUnacknowledged = nullptr;
    QAction *acknowledge = nullptr;
    QAction *acknowledgeAll = nullptr;
    PanelSettings settings{"severity", "unacknowledged", "search", "columns"};
    bool isFollowing = true;

    QWidget *makeBar(QWidget *parent)
    {
        auto *bar = new QWidget(parent);
        auto *row = new QHBoxLayout(bar);
        row->setContentsMargins(4, 3, 4, 3);
        row->setSpacing(4);
        row->addWidget(severity);
        row->addWidget(search, 1);
        for (QAction *action : {onlyUnacknowledged, acknowledge, acknowledgeAll}) {
            auto *button = new QToolButton(bar);
            button->setDefaultAction(action);
            button->setAutoRaise(true);
            button->setFocusPolicy(Qt::TabFocus);
            row->addWidget(button);
        }
        return bar;
    }

    /// New rows do not move what somebody reads.
    void follow()
    {
        QScrollBar *bar = table->verticalScrollBar();
        QObject::connect(bar, &QScrollBar::valueChanged, table,
                         [this, bar](int value) { isFollowing = value == bar->maximum(); });
        QObject::connect(bar, &QScrollBar::rangeChanged, table, [this, bar](int, int maximum) {
            if (isFollowing)
                bar->setValue(maximum);
        });
    }
};

QPlcEventLog::QPlcEventLog(QWidget *parent)
    : QPlcWidget(parent)
    , d(std::make_unique<Private>())
{
    d->table = new PanelTable(signOfEvent, PanelTable::Sorting::None, this);
    d->table->setAccessibleName(tr("Events"));
    d->filter = new EventFilterModel(this);
    d->table->setModel(d->filter);
    d->severity = new QComboBox(this);
    d->severity->addItems({tr("All"), tr("Warnings"), tr("Errors")});
    d->severity->setAccessibleName(tr("Least severity"));
    d->severity->setToolTip(tr("Shows events that are at least so severe"));
    d->search = new QLineEdit(this);
    d->search->setObjectName(QStringLiteral("search"));
    d->search->setPlaceholderText(tr("Search events"));
    d->search->setAccessibleName(tr("Search events"));
    d->search->setClearButtonEnabled(true);
    makeActions();
    auto *column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addWidget(d->makeBar(this));
    column->addWidget(d->table);
    setFocusProxy(d->table);
    d->follow();
}

QPlcEventLog::~QPlcEventLog() = default;

void QPlcEventLog::makeActions()
{
    const auto make = [this](const QString &text, const QString &shortText, const QKeySequence &key) {
        auto *action = new QAction(text, this);
        action->setIconText(shortText);
        action->setShortcut(key);
        action->setShortcutContext(Qt::WidgetWithChildrenShortcut);
        action->setToolTip(QStringLiteral("%1 (%2)").arg(text, key.toString(QKeySequence::NativeText)));
        addAction(action);
        return action;
    };
    d->onlyUnacknowledged
        = make(tr("Show only what is active or not acknowledged"), tr("Open"), QKeySequence(Qt::Key_O));
    d->onlyUnacknowledged->setCheckable(true);
    d->acknowledge = make(tr("Acknowledge the selected events"), tr("Ack"), QKeySequence(Qt::Key_A));
    d->acknowledgeAll
        = make(tr("Acknowledge all events"), tr("Ack all"), QKeySequence(int(Qt::SHIFT) | int(Qt::Key_A)));
    QAction *find = make(tr("Search events"), tr("Search"), QKeySequence(QKeySequence::Find));
    connect(find, &QAction::triggered, d->search, [this] { d->search->setFocus(Qt::ShortcutFocusReason); });
    leaveByEscape(d->search, d->table);
    const auto take = [this](const char *key, const QJsonValue &value, const QJsonValue &defaultValue) {
        if (!d->settings.set(key, value, defaultValue))
            return;
        filter();
        Q_EMIT settingsEdited();
    };
    connect(d->onlyUnacknowledged, &QAction::triggered, this,
            [take](bool isOn) { take("unacknowledged", isOn, false); });
    connect(d->severity, QOverload<int>::of(&QComboBox::activated), this,
            [take](int place) { take("severity", severities.at(place), severities.first()); });
    connect(d->search, &QLineEdit::textEdited, this, [take](const QString &text) { take("search", text, QString()); });
    connect(d->search, &QLineEdit::textChanged, this, [take](const QString &text) {
        if (text.isEmpty())  // by its button
            take("search", text, QString());
    });
}

QJsonObject QPlcEventLog::settings() const
{
    return settingsWith(d->settings.toJson());
}

void QPlcEventLog::applySettings(const QJsonObject &settings)
{
    QPlcWidget::applySettings(d->settings.take(settings));
    filter();
    if (d->context)
        d->table->applySettings(d->settings);
}

void QPlcEventLog::filter()
{
    const int severity = std::max(0, severities.indexOf(d->settings.value("severity").toString()));
    const QString search = d->settings.value("search").toString();
    const bool isOnlyUnacknowledged = d->settings.value("unacknowledged").toBool();
    d->severity->setCurrentIndex(severity);
    if (d->search->text() != search)
        d->search->setText(search);
    d->onlyUnacknowledged->setChecked(isOnlyUnacknowledged);
    d->filter->setLeastSeverity(PlantEvent::Severity(severity));
    d->filter->setOnlyOpen(isOnlyUnacknowledged);
    d->filter->setSearch(search);
}

void QPlcEventLog::contextChanged()
{
    d->context = context();
    d->filter->setSourceModel(context()->eventModel());
    d->table->setContext(context());
    d->table->setColumns(eventColumns);
    d->table->setStretchedColumn(EventLogModel::Text, 30);
    d->table->setDispensable(
        {EventLogModel::Source, EventLogModel::State, EventLogModel::Severity});  // seen by its colour
    d->table->applySettings(d->settings);
    connect(d->table, &PanelTable::settingsEdited, this, [this] {
        d->table->writeSettings(&d->settings);
        Q_EMIT settingsEdited();
    });
    connect(d->table, &QAbstractItemView::activated, this, [this](const QModelIndex &index) {
        const QPlcTimeAxis::Time time = index.data(QPlcPanelContext::EventTimeRole).toLongLong() * 1'000'000;
        context()->timeAxis()->jumpTo(time);
        context()->timeAxis()->setPointer(time);  // so that gauges and tables show this time too
    });
    connect(d->acknowledge, &QAction::triggered, this, [this] {
        QList<QPersistentModelIndex> chosen;  // acknowledging may filter rows away
        const QModelIndexList selected = d->table->selectionModel()->selectedRows();
        for (const QModelIndex &index : selected)
            chosen << d->filter->mapToSource(index);
        for (const QPersistentModelIndex &index : qAsConst(chosen))
            context()->eventModel()->setData(index, true, QPlcPanelContext::AcknowledgedRole);
    });
    connect(d->acknowledgeAll, &QAction::triggered, context(), &QPlcPanelContext::acknowledgeEvents);
    const auto count = [this] { d->acknowledgeAll->setEnabled(context()->unacknowledgedEvents() > 0); };
    connect(context(), &QPlcPanelContext::unacknowledgedEventsChanged, this, count);
    count();
    addAction(d->table->createColumnMenu(this)->menuAction());
}

QSize QPlcEventLog::sizeHint() const
{
    return {560, 180};
}
