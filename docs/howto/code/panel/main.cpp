// SPDX-License-Identifier: Apache-2.0
#include "TwoCurves.h"

int main(int argc, char **argv)
{
    QPlcGuiApplication application(argc, argv);
    QPlcControlCenter window;
    window.addPanel<TwoCurves>();
    window.restoreView();
    window.connectToMaster(application.arguments().value(1, QStringLiteral("localhost:50000")));
    window.show();
    return application.exec();
}
