// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "BarButton.h"
#include "gui/panel/WindowContext.h"

#include <QtCore/QPointer>

class QLabel;

namespace qplc {

/// A red line over everything while the master of a plant has stopped safely, or cannot run: why,
/// what has to be done first, and a button that resets it. Hidden otherwise. With several plants it
/// is about the first of them that has to be reset.
class LatchBanner : public QWidget
{
    Q_OBJECT
public:
    /// \param context  outlives the banner
    explicit LatchBanner(WindowContext *context, QWidget *parent = nullptr);

    /// The sentence; empty while nothing is latched.
    QString text() const { return m_text; }
    /// Null while nothing is latched.
    Plant *plant() const { return m_plant; }
    BarButton *resetButton() const { return m_reset; }

Q_SIGNALS:
    void resetRequested(qplc::Plant *plant);

protected:
    void paintEvent(QPaintEvent *event) override;

private:
    void follow();
    void colour();

    WindowContext *m_context;
    QLabel *m_label;
    BarButton *m_reset;
    QPointer<Plant> m_plant;
    QString m_text;
};

}  // namespace qplc
