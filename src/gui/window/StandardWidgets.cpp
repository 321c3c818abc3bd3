// SPDX-License-Identifier: Apache-2.0
#include "StandardWidgets.h"

#include "QPlcEventLog.h"
#include "QPlcGauge.h"
#include "QPlcJitterHistogram.h"
#include "QPlcKeyboardControl.h"
#include "QPlcNodeTable.h"
#include "QPlcSetter.h"
#include "QPlcSignalTree.h"
#include "QPlcSpectrum.h"
#include "QPlcTimePlot.h"
#include "QPlcValueTable.h"
#include "QPlcWidget.h"
#include "QPlcXyPlot.h"

namespace qplc {

namespace {

template<typename... Factories>
QList<QPlcWidgetFactory *> registered()
{
    return {QPlcWidget::registerFactory(new Factories)...};
}

}  // namespace

QList<QPlcWidgetFactory *> standardWidgets()
{
    // In the order of menus.
    static const QList<QPlcWidgetFactory *> all
        = registered<QPlcTimePlotFactory, QPlcXyPlotFactory, QPlcSpectrumFactory, QPlcGaugeFactory, QPlcSetterFactory,
                     QPlcKeyboardControlFactory, QPlcValueTableFactory, QPlcSignalTreeFactory, QPlcNodeTableFactory,
                     QPlcJitterHistogramFactory, QPlcEventLogFactory>();
    return all;
}

}  // namespace qplc
