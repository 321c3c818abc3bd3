// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/panel/WindowContext.h"

#include <QtWidgets/QWidget>

class QHBoxLayout;
class QLabel;

namespace qplc {

/// A line over the panels with a sentence, in the colour of a warning; hidden while it has nothing
/// to say.
class NoticeLine : public QWidget
{
    Q_OBJECT
public:
    /// The sentence; empty while there is nothing to say.
    QString text() const;

protected:
    /// \param context  outlives the line
    NoticeLine(WindowContext *context, QWidget *parent);
    void paintEvent(QPaintEvent *event) override;

    /// \param text  empty: hides the line
    void say(const QString &text);
    WindowContext *context() const { return m_context; }
    QLabel *label() const { return m_label; }
    /// What stands beside the sentence.
    QHBoxLayout *row() const { return m_row; }

private:
    WindowContext *m_context;
    QLabel *m_label;
    QHBoxLayout *m_row;
};

}  // namespace qplc
