// SPDX-License-Identifier: Apache-2.0
// plant_window ADDRESS [SIGNAL VALUE]: a window without a face. Hears the plant of the address,
// takes control of the signal, if there is one, and prints ten times a second what it has, "rows
// gaps largestBatch rowsOfTheStore". Ends with its standard input.
#include "gui/plant/Plant.h"

#include <QtCore/QCoreApplication>
#include <QtCore/QSocketNotifier>

#include <cstdio>

int main(int argc, char **argv)
{
    QCoreApplication application(argc, argv);
    qplc::Plant plant(QCoreApplication::arguments().value(1));
    int largestBatch = 0;
    QObject::connect(&plant, &qplc::Plant::updated, &plant,
                     [&] { largestBatch = std::max(largestBatch, plant.values().batchSize()); });
    QTimer timer;
    QObject::connect(&timer, &QTimer::timeout, &plant, [&] {
        const qplc::SignalStore *store = plant.store();
        const auto kept = store ? qulonglong(store->endRow() - store->firstRow()) : 0;
        std::printf("%llu %llu %d %llu\n", plant.values().rows(), plant.values().gaps(), largestBatch, kept);
        std::fflush(stdout);
    });
    QSocketNotifier end(0, QSocketNotifier::Read);
    QObject::connect(&end, &QSocketNotifier::activated, &application, &QCoreApplication::quit);
    const QString held = QCoreApplication::arguments().value(2);
    const QPlcValue value(QCoreApplication::arguments().value(3).toDouble());
    bool isTaken = held.isEmpty();
    QObject::connect(&timer, &QTimer::timeout, &plant, [&] {
        if (isTaken || !plant.hasLeases() || !plant.table().contains(held))
            return;
        plant.takeLease({held}, {{held, value}});
        isTaken = true;
    });
    timer.start(100);
    plant.open();
    return QCoreApplication::exec();
}
