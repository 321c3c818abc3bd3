// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "PlotCurves.h"
#include "gui/models/SiPrefix.h"

#include <QtWidgets/QWidget>

namespace qplc {

/// The curves of a plot in a small table: colour, name, value and unit, in as many columns as there
/// is room for.
///
/// Where there is little room, names are elided and values stay. Values have so many digits always,
/// and units the prefix that fits.
///
/// A click hides a curve or shows it again, and makes it the selected one. Values that are not true
/// any more are grey, with their age; what is missing says so.
class PlotLegend : public QWidget
{
    Q_OBJECT
public:
    struct Entry
    {
        QString name;
        QString value;
        QString unit;
        QString doubt;  // why the value is not one of its time: its age, or its quality
        QString hint;   // what is shown when the mouse rests on it
        QColor color;
        Qt::PenStyle penStyle = Qt::SolidLine;
        bool isVisible = true;
        bool isTrusted = true;
        bool isSelected = false;
        friend bool operator==(const Entry &a, const Entry &b)
        {
            return a.name == b.name && a.value == b.value && a.unit == b.unit && a.doubt == b.doubt && a.hint == b.hint
                && a.color == b.color && a.penStyle == b.penStyle && a.isVisible == b.isVisible
                && a.isTrusted == b.isTrusted && a.isSelected == b.isSelected;
        }
    };

    explicit PlotLegend(QWidget *parent = nullptr);

    void setTheme(const QPlcTheme &theme);
    void setCompact(bool isCompact);
    /// Shows the values of a time, the newest ones without.
    void show(const PlotCurves &curves, std::optional<QPlcPast::Time> time);
    const QVector<Entry> &entries() const { return m_entries; }
    /// The place of an entry [px]; null: it is not seen.
    QRect entryRect(int place) const;
    /// The place of its value [px]
    QRect valueRect(int place) const;
    void paint(QPainter *painter, bool hasHover) const;

    bool hasHeightForWidth() const override { return true; }
    int heightForWidth(int width) const override;
    /// The height of as many whole lines as there is room for, but of one at least [px]
    int heightWithin(int width, int room) const;
    QSize sizeHint() const override;
    QSize minimumSizeHint() const override { return {1, 1}; }

Q_SIGNALS:
    void clicked(int place);
    void menuWanted(int place, const QPoint &global);

protected:
    void paintEvent(QPaintEvent *event) override;
    void mousePressEvent(QMouseEvent *event) override;
    void mouseMoveEvent(QMouseEvent *event) override;
    void leaveEvent(QEvent *event) override;
    void contextMenuEvent(QContextMenuEvent *event) override;
    bool event(QEvent *event) override;
    void changeEvent(QEvent *event) override;

private:
    struct Parts
    {
        QRect name;
        QRect value;
        QRect unit;
    };
    Parts partsOf(const QRect &rect) const;
    void measure();
    int columnsFor(int width) const;
    int entryAt(QPoint position) const;
    int doubtWidth(const Entry &entry) const;
    QRect paintDoubt(QPainter *painter, const QRect &room, const Entry &entry) const;
    void paintSwatch(QPainter *painter, const QRect &box, const Entry &entry) const;
    void paintEntry(QPainter *painter, const QRect &rect, const Entry &entry) const;
    int wantedWidth() const;
    int leastWidth() const;
    QFont valueFontOf(const Entry &entry) const;
    void fillValue(const PlotCurves &curves, int place, std::optional<QPlcPast::Time> time, Entry *entry);
    QFont fontOf(const Entry &entry) const;

    QPlcTheme m_theme;
    QVector<Entry> m_entries;
    QVector<SiPrefix> m_prefixes;  // of the entries
    int m_hovered = -1;
    bool m_isCompact = false;
    int m_nameWidth = 0;  // [px], of the widest
    int m_valueWidth = 0;
    int m_unitWidth = 0;
    int m_lineHeight = 0;
};

}  // namespace qplc
