// SPDX-License-Identifier: Apache-2.0
#pragma once

class QLineEdit;
class QWidget;

namespace qplc {

class PlantList;

/// A field for a signal that completes the names of all signals there are. \param plants  null: it completes none
QLineEdit *createSignalField(const PlantList *plants, QWidget *parent);

}  // namespace qplc
