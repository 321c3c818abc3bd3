// SPDX-License-Identifier: Apache-2.0
#include <QtPlcGui>

int main(int argc, char **argv)
{
    QPlcGuiApplication application(argc, argv);
    QPlcControlCenter window;
    window.restoreView();
    window.connectToMaster(QStringLiteral("localhost:50000"));
    window.show();
    return application.exec();
}
