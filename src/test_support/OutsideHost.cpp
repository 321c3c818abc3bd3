// SPDX-License-Identifier: Apache-2.0
#include "OutsideHost.h"

#include <QtCore/QtGlobal>

namespace qplc {

std::unique_ptr<Strand> OutsideHost::makeStrand()
{
    qFatal("QPlcSimulator: cycles begin outside of QPlcSimulatedHost::call(), where no host runs them; call the "
           "function of the master or node inside: host.call([&] { ... })");
}

ControlNetwork *OutsideHost::controlNetwork() noexcept
{
    qFatal("QPlcSimulator: a master, node or tool is made, connects or listens outside of QPlcSimulatedHost::call(), "
           "where there is no network; use it inside: host.call([&] { ... })");
}

}  // namespace qplc
