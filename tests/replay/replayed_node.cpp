// SPDX-License-Identifier: Apache-2.0
// The second node of the chain of RecordedMaster.h as a program. An argument is another gain.
#include "RecordedMaster.h"

int main(int argc, char **argv)
{
    QPlcNodeApplication application(argc, argv);
    application.addOption({"gain", "Factor of inputs.", "FACTOR", "0.1"});
    if (!application.parseNodeOptions())
        return application.exitCode();
    Chain chain;
    chain.second.gain = application.value("gain").toDouble();
    return application.run(chain.second);
}
