// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcMessage.h"

#include <limits>

namespace qplc::messages {

/// Whether \a number is a kind of this version. An enumerator without a row does not compile.
#pragma GCC diagnostic push
#pragma GCC diagnostic error "-Wswitch"
constexpr bool isKind(quint8 number)
{
    using Kind = QPlcMessage;
    switch (QPlcMessage::Kind(number)) {
    case Kind::Invalid:
        return false;
    case Kind::Hello:
    case Kind::Register:
    case Kind::Registered:
    case Kind::Rejected:
    case Kind::AttachCyclicChannel:
    case Kind::CyclicChannelAttached:
    case Kind::MasterEnds:
    case Kind::InitializeAllStates:
    case Kind::SendYourInitialOutputStates:
    case Kind::ReceiveMyInitialOutputStates:
    case Kind::InitializeWithValues:
    case Kind::Initialized:
    case Kind::StatesInitialized:
    case Kind::StartRealTime:
    case Kind::RealTimeStarted:
    case Kind::RealTimeReady:
    case Kind::Stop:
    case Kind::RealTimeStopped:
    case Kind::SafeStop:
    case Kind::Reset:
    case Kind::Arm:
    case Kind::Armed:
    case Kind::GetState:
    case Kind::State:
    case Kind::GetSignals:
    case Kind::Signals:
    case Kind::SetSignals:
    case Kind::Done:
    case Kind::Failed:
    case Kind::NodeFault:
    case Kind::GetStatistics:
    case Kind::Statistics:
    case Kind::GetSchedule:
    case Kind::Schedule:
    case Kind::TakeLease:
    case Kind::ReleaseLease:
    case Kind::GetLeases:
    case Kind::Leases:
    case Kind::LeasesChanged:
    case Kind::GetEvents:
    case Kind::Events:
        return true;
    }
    return false;
}
#pragma GCC diagnostic pop

/// Whether \a isListed is true for every kind, and for nothing else.
template<typename IsListed>
constexpr bool isEveryKind(IsListed isListed)
{
    for (int number = 0; number <= std::numeric_limits<quint8>::max(); ++number) {
        if (isKind(quint8(number)) != isListed(QPlcMessage::Kind(number)))
            return false;
    }
    return true;
}

}  // namespace qplc::messages
