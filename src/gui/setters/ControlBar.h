// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtWidgets/QWidget>

class QAction;
class QToolButton;
class QPlcSignalControl;

struct QPlcTheme;

namespace qplc {

class ElidedLabel;

/// Who has control of some signals, in a line, with the buttons to take it and to give it back. To
/// take it from another person is asked here, in the line itself.
class ControlBar : public QWidget
{
    Q_OBJECT
public:
    enum Size { Small, Large };

    /// \param control  outlives the bar
    ControlBar(QPlcSignalControl *control, Size size, QWidget *parent);

    QAction *takeAction() const { return m_take; }
    QAction *giveBackAction() const { return m_giveBack; }
    void setTheme(const QPlcTheme &theme);
    /// A hint beside it all, of what was done last; empty: who has control.
    void say(const QString &sentence);

Q_SIGNALS:
    /// A person has asked for control, or given it back.
    void handled();

private:
    QToolButton *addButton(QAction *action);
    void makeActions();
    void take();
    void ask(bool asks);
    void refresh();
    QColor color() const;

    QPlcSignalControl *m_control;
    Size m_size;
    ElidedLabel *m_headline = nullptr;
    ElidedLabel *m_text;
    QAction *m_take;
    QAction *m_giveBack;
    QAction *m_takeOver;
    QAction *m_leave;
    bool m_isAsking = false;
    QString m_sentence;
    QColor m_plain;
    QColor m_held;
    QColor m_alarm;
    QColor m_muted;
};

}  // namespace qplc
