// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "WindWindowDrawing.h"

#include <QtWidgets/QWidget>

namespace awe {

/// The wind window as a part of another panel.
class WindWindowView : public QWidget
{
    Q_OBJECT
public:
    /// \param kite, context  of the panel, which outlive this
    WindWindowView(const KiteSignals *kite, QPlcPanelContext *context, QWidget *parent)
        : QWidget(parent)
        , m_kite(kite)
        , m_context(context)
    {
        connect(context, &QPlcPanelContext::changed, this, QOverload<>::of(&QWidget::update));
    }
    const KiteSignals &kite() const { return *m_kite; }

protected:
    void paintEvent(QPaintEvent * /*event*/) override
    {
        QPainter painter(this);
        drawWindWindow(&painter, size(), *m_kite, m_context->theme());
    }

private:
    const KiteSignals *m_kite;
    QPlcPanelContext *m_context;
};

}  // namespace awe
