// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/panel/WindowContext.h"

#include <QtWidgets/QWidget>

class QHBoxLayout;
class QLabel;
class QLineEdit;
class QVBoxLayout;

namespace qplc {

/// A line that a person writes, over the panels and without stopping anything: Enter accepts it,
/// Escape closes the strip. What is wrong with it stands below until it is edited.
class EntryStrip : public QWidget
{
    Q_OBJECT
public:
    QLineEdit *line() const { return m_line; }
    /// \param sentence  empty: nothing is wrong
    void showError(const QString &sentence);
    /// Empty: none is shown.
    QString error() const;

protected:
    /// Makes a hidden strip. \param context  outlives it
    EntryStrip(WindowContext *context, QWidget *parent);
    void keyPressEvent(QKeyEvent *event) override;
    void paintEvent(QPaintEvent *event) override;

    virtual void accept() = 0;
    virtual void leave() { hide(); }

    WindowContext *context() const { return m_context; }
    /// What the line is for.
    QLabel *label() const { return m_label; }
    /// With the label and the line; buttons come behind.
    QHBoxLayout *row() const { return m_row; }
    /// With the row and the error.
    QVBoxLayout *column() const { return m_column; }

private:
    WindowContext *m_context;
    QLabel *m_label;
    QLineEdit *m_line;
    QLabel *m_error;
    QHBoxLayout *m_row;
    QVBoxLayout *m_column;
};

}  // namespace qplc
