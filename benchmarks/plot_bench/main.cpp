// SPDX-License-Identifier: Apache-2.0
// qtplc_plot_bench: measures what live time plots cost, and prints one line of JSON.
#include "PlotBench.h"

#include <QtCore/QJsonDocument>
#include <QtWidgets/QApplication>

#include <cstdio>

int main(int argc, char **argv)
{
    if (qEnvironmentVariableIsEmpty("QT_QPA_PLATFORM"))
        qputenv("QT_QPA_PLATFORM", "offscreen");
    const QApplication application(argc, argv);
    PlotBenchOptions options;
    int exitCode = 0;
    if (!PlotBenchOptions::read(application, &options, &exitCode))
        return exitCode;
    PlotBench bench(options);
    bench.run();
    std::puts(QJsonDocument(bench.result()).toJson(QJsonDocument::Compact).constData());
    if (!options.picture.isEmpty() && !bench.savePicture()) {
        std::fprintf(stderr, "qtplc_plot_bench: --picture %s: cannot be written, use a file in a folder that exists\n",
                     qPrintable(options.picture));
        return 1;
    }
    return 0;
}
