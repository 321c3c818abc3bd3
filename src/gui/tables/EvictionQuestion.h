// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/models/NodeEviction.h"

#include <QtCore/QTimer>
#include <QtWidgets/QFrame>

class QLabel;
class QPushButton;

namespace qplc {

/// A line below the nodes that tells what an eviction or an admission would do, and asks whether to
/// do it. Hidden while nothing is asked.
///
/// It is for people in a hurry: it never has the keyboard on the button that acts, a double click
/// does not reach that button, and a question that is not true any more ends.
class EvictionQuestion : public QFrame
{
    Q_OBJECT
public:
    explicit EvictionQuestion(QWidget *parent = nullptr);

    void ask(const NodeEviction &eviction);
    /// The plant may have changed.
    void follow();

Q_SIGNALS:
    void ended();

private:
    void end();

    NodeEviction m_eviction;
    QLabel *m_text;
    QPushButton *m_act;
    QPushButton *m_cancel;
    QTimer m_pause;  // runs while a second click may belong to the one that has asked
};

}  // namespace qplc
