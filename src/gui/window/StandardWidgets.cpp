// SPDX-License-Identifier: Apache-2.0
#include "StandardWidgets.h"

#include "QPlcWidget.h"

namespace qplc {

namespace {

/// The panels, in the order of menus.
template<typename... Factories>
QList<QPlcWidgetFactory *> registered()
{
    return {QPlcWidget::registerFactory(new Factories)...};
}

}  // namespace

QList<QPlcWidgetFactory *> standardWidgets()
{
    static const QList<QPlcWidgetFactory *> all = registered<>();
    return all;
}

}  // namespace qplc
