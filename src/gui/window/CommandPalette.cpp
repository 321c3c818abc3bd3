// SPDX-License-Identifier: Apache-2.0
#include "CommandPalette.h"

#include "FuzzyMatch.h"

#include <QtGui/QKeyEvent>
#include <QtGui/QPainter>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QListWidget>
#include <QtWidgets/QStyledItemDelegate>
#include <QtWidgets/QVBoxLayout>

#include <algorithm>

namespace qplc {

namespace {

constexpr int mostShown = 60;
enum Role { PlaceRole = Qt::UserRole, GroupRole, KeysRole };

/// Text at the left; group and keys, muted, at the right.
class ItemDelegate : public QStyledItemDelegate
{
public:
    ItemDelegate(WindowContext *context, QObject *parent)
        : QStyledItemDelegate(parent)
        , m_context(context)
    {
    }

    void paint(QPainter *painter, const QStyleOptionViewItem &option, const QModelIndex &index) const override
    {
        const Theme &theme = m_context->theme();
        const bool isCurrent = option.state.testFlag(QStyle::State_Selected);
        const QPalette palette = theme.palette();
        painter->fillRect(option.rect, isCurrent ? palette.color(QPalette::Highlight) : theme.surface);
        const QColor text = isCurrent ? palette.color(QPalette::HighlightedText) : theme.text;
        const QRect rect = option.rect.adjusted(12, 0, -12, 0);
        const QString keys = index.data(KeysRole).toString();
        const QString side
            = index.data(GroupRole).toString() + (keys.isEmpty() ? QString() : QStringLiteral("    ") + keys);
        painter->setPen(isCurrent ? text : theme.mutedText);
        painter->drawText(rect, Qt::AlignRight | Qt::AlignVCenter, side);
        const int room = rect.width() - option.fontMetrics.horizontalAdvance(side) - 16;
        painter->setPen(text);
        painter->drawText(rect, Qt::AlignLeft | Qt::AlignVCenter,
                          option.fontMetrics.elidedText(index.data().toString(), Qt::ElideRight, room));
    }

    QSize sizeHint(const QStyleOptionViewItem &option, const QModelIndex & /*index*/) const override
    {
        return {100, option.fontMetrics.height() + 12};
    }

private:
    WindowContext *m_context;
};

}  // namespace

CommandPalette::CommandPalette(WindowContext *context, QWidget *parent)
    : QFrame(parent, Qt::Popup)
    , m_context(context)
    , m_line(new QLineEdit)
    , m_list(new QListWidget)
{
    setObjectName(QStringLiteral("CommandPalette"));
    setFrameShape(QFrame::StyledPanel);
    m_line->setAccessibleName(tr("Search commands"));
    m_line->installEventFilter(this);
    m_list->setFrameShape(QFrame::NoFrame);
    m_list->setFocusPolicy(Qt::NoFocus);
    m_list->setUniformItemSizes(true);
    m_list->setItemDelegate(new ItemDelegate(context, m_list));
    auto *column = new QVBoxLayout(this);
    column->setContentsMargins(8, 8, 8, 8);
    column->addWidget(m_line);
    column->addWidget(m_list);
    setFocusProxy(m_line);
    connect(m_line, &QLineEdit::textChanged, this, &CommandPalette::fill);
    connect(m_line, &QLineEdit::returnPressed, this, &CommandPalette::runCurrent);
    connect(m_list, &QListWidget::itemClicked, this, &CommandPalette::runCurrent);
}

void CommandPalette::open(const QVector<PaletteItem> &items, const QString &question)
{
    m_items = items;
    m_line->setPlaceholderText(question);
    m_line->clear();
    fill();
    const QSize room = parentWidget()->size();
    resize(std::min(620, room.width() - 40), std::min(420, room.height() - 80));
    move(parentWidget()->mapToGlobal(QPoint((room.width() - width()) / 2, 60)));
    show();
    m_line->setFocus(Qt::PopupFocusReason);
}

QVector<int> CommandPalette::matches(const QVector<PaletteItem> &items, const QString &pattern, int most)
{
    QVector<QPair<int, int>> scored;
    for (int place = 0; place < items.size(); ++place) {
        const int score = fuzzyScore(pattern, items[place].text);
        if (score >= 0)
            scored.append({-score, place});
    }
    std::sort(scored.begin(), scored.end());
    QVector<int> places;
    for (const auto &each : qAsConst(scored).mid(0, most))
        places.append(each.second);
    return places;
}

void CommandPalette::fill()
{
    m_list->clear();
    for (const int place : matches(m_items, m_line->text(), mostShown)) {
        const PaletteItem &item = m_items[place];
        auto *row = new QListWidgetItem(item.text, m_list);
        row->setData(PlaceRole, place);
        row->setData(GroupRole, item.group);
        row->setData(KeysRole, item.keys);
    }
    m_list->setCurrentRow(0);
}

void CommandPalette::runCurrent()
{
    const QListWidgetItem *current = m_list->currentItem();
    if (!current)
        return;
    const std::function<void()> run = m_items[current->data(PlaceRole).toInt()].run;
    hide();
    run();
}

bool CommandPalette::eventFilter(QObject *watched, QEvent *event)
{
    if (event->type() != QEvent::KeyPress)
        return QFrame::eventFilter(watched, event);
    const int key = static_cast<QKeyEvent *>(event)->key();
    const int step = key == Qt::Key_Down ? 1
        : key == Qt::Key_Up              ? -1
        : key == Qt::Key_PageDown        ? 8
        : key == Qt::Key_PageUp          ? -8
                                         : 0;
    if (step == 0 || m_list->count() == 0)
        return QFrame::eventFilter(watched, event);
    m_list->setCurrentRow(qBound(0, m_list->currentRow() + step, m_list->count() - 1));
    return true;
}

}  // namespace qplc
