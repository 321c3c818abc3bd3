// SPDX-License-Identifier: Apache-2.0
#include "QPlcWidgetFactory.h"

QPlcWidgetFactory::~QPlcWidgetFactory() = default;
