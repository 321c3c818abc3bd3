// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtGui/QColor>
#include <QtWidgets/QToolButton>
#include <QtWidgets/QWidget>

class QBoxLayout;
class QPainter;

namespace qplc {

/// The slim line above a panel: its title, and buttons for actions. It is dragged with the mouse,
/// renamed in place, and takes the keyboard.
class PanelTitleBar : public QWidget
{
    Q_OBJECT
public:
    explicit PanelTitleBar(QWidget *parent = nullptr);

    QString title() const { return m_title; }
    void setTitle(const QString &title);
    /// What stands behind the title in colour: of which plants the panel is.
    struct Badge
    {
        QString text;  // empty: there is no badge
        QColor color;
        QColor textColor;
        QString toolTip;
        bool isPinned = false;  // with a pin before the text

        friend bool operator==(const Badge &a, const Badge &b)
        {
            return a.text == b.text && a.color == b.color && a.textColor == b.textColor && a.toolTip == b.toolTip
                && a.isPinned == b.isPinned;
        }
    };
    const Badge &badge() const { return m_badge; }
    void setBadge(const Badge &badge);
    /// Where the badge is drawn; empty without one.
    QRect badgeRect() const;
    /// When a button is there: what can also be done by a double click, keys and the context menu
    /// gives its place to the title of a narrow panel.
    enum Presence { Always, WhereThereIsRoom };
    /// A button at the right that shows and triggers \a action.
    QToolButton *addButton(QAction *action, Presence presence = Always);
    /// Pictures for others have no buttons.
    void setButtonsShown(bool areShown);
    /// Whether the keyboard is in the panel.
    void setActive(bool isActive);
    void startRename();

    QSize sizeHint() const override;
    QSize minimumSizeHint() const override;

Q_SIGNALS:
    void renamed(const QString &title);
    void doubleClicked();
    void badgeClicked();
    void dragMoved(const QPoint &globalPosition);
    void dragFinished(const QPoint &globalPosition);
    void dragCancelled();

protected:
    void paintEvent(QPaintEvent *event) override;
    void resizeEvent(QResizeEvent *event) override;
    void changeEvent(QEvent *event) override;
    void mousePressEvent(QMouseEvent *event) override;
    void mouseMoveEvent(QMouseEvent *event) override;
    void mouseReleaseEvent(QMouseEvent *event) override;
    void mouseDoubleClickEvent(QMouseEvent *event) override;
    bool eventFilter(QObject *watched, QEvent *event) override;
    bool event(QEvent *event) override;
    void hideEvent(QHideEvent *event) override;

private:
    enum Drag { NotPressed, Pressed, Dragging };

    QRect lineRect() const;
    QRect titleRect() const;
    void drawBadge(QPainter *painter) const;
    void fitButtons();
    void endDrag();

    QString m_title;
    Badge m_badge;
    QBoxLayout *m_buttons;
    QVector<QToolButton *> m_optional;  // there only where there is room
    bool m_areButtonsShown = true;
    bool m_isActive = false;
    Drag m_drag = NotPressed;
    QPoint m_pressed;
};

}  // namespace qplc
