// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "History.h"
#include "SoakPlant.h"

namespace soak {

/// What the runner tells a process of the plant.
struct NodeOptions
{
    PlantShape shape;
    int node = 0;
    quint32 life = 1;
};

void addShapeOptions(QPlcCoreApplication &application);
void addNodeOptions(QPlcCoreApplication &application);
/// Reads --nodes, --signal-count, --hold, --life and opens the history. \return false, with the
/// message out, when one of them cannot be meant
bool readShapeOptions(QPlcCoreApplication &application, NodeOptions *options, HistoryFile *history);
/// The same, and --node.
bool readNodeOptions(QPlcCoreApplication &application, NodeOptions *options, HistoryFile *history);
QStringList shapeArguments(const PlantShape &shape, quint32 life, const QString &historyFile);

}  // namespace soak
