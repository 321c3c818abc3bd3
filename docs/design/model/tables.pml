/* SPDX-License-Identifier: Apache-2.0
   The tables of states of master and node. Written by tests/states/promela_tables from
   src/node/state; do not edit. */

#define Accepted 0
#define Ignored 1
#define Refused 2

#define go(next, what) verdict = Accepted; state = next; action = what
#define stay(what) verdict = Accepted; action = what
#define ignore() verdict = Ignored; action = 0
#define refuse() verdict = Refused; action = 0

#define M_Off 0
#define M_Initializing 1
#define M_Ready 2
#define M_RealTime 3
#define M_WaitingForLateSlaves 4
#define M_SafeStop 5
#define M_Fault 6

#define ME_Initialize 0
#define ME_InitializeIncomplete 1
#define ME_Arm 2
#define ME_Start 3
#define ME_StartIncomplete 4
#define ME_StartUnarmed 5
#define ME_Stop 6
#define ME_SafeStop 7
#define ME_Reset 8
#define ME_ResetTooEarly 9
#define ME_Listen 10
#define ME_AddNode 11
#define ME_End 12
#define ME_StatesInitialized 13
#define ME_CyclesStarted 14
#define ME_SequenceFailed 15
#define ME_ThreadFailed 16
#define ME_ServerListens 17
#define ME_ServerFailed 18
#define ME_NodeJoined 19
#define ME_ListenerJoined 20
#define ME_NodeLeft 21
#define ME_CriticalNodeLeft 22
#define ME_NodeFailed 23
#define ME_CriticalNodeFailed 24
#define ME_WaitBegan 25
#define ME_WaitEnded 26
#define ME_CyclesTripped 27
#define ME_CycleLimitReached 28
#define ME_OverrunStop 29

#define MA_None 0
#define MA_CollectOutputs 1
#define MA_CollectThenStart 2
#define MA_StartNodes 3
#define MA_IssueToken 4
#define MA_EndSequence 5
#define MA_ForgetInitialization 6
#define MA_EndCycles 7
#define MA_MakeCyclesSafe 8
#define MA_LatchReason 9
#define MA_Unlatch 10
#define MA_LetJoin 11

inline masterTable(state, event)
{
    if
    :: event == ME_Initialize ->
        if
        :: state == M_Off || state == M_Ready -> go(M_Initializing, MA_CollectOutputs)
        :: state == M_Initializing || state == M_RealTime || state == M_WaitingForLateSlaves || state == M_SafeStop || state == M_Fault -> refuse()
        fi
    :: event == ME_InitializeIncomplete ->
        if
        :: state == M_Off || state == M_Initializing || state == M_Ready || state == M_RealTime || state == M_WaitingForLateSlaves || state == M_SafeStop || state == M_Fault -> refuse()
        fi
    :: event == ME_Arm ->
        if
        :: state == M_Off || state == M_Initializing || state == M_RealTime || state == M_WaitingForLateSlaves || state == M_SafeStop || state == M_Fault -> refuse()
        :: state == M_Ready -> stay(MA_IssueToken)
        fi
    :: event == ME_Start ->
        if
        :: state == M_Off -> go(M_Initializing, MA_CollectThenStart)
        :: state == M_Initializing || state == M_RealTime || state == M_WaitingForLateSlaves || state == M_SafeStop || state == M_Fault -> refuse()
        :: state == M_Ready -> go(M_Initializing, MA_StartNodes)
        fi
    :: event == ME_StartIncomplete ->
        if
        :: state == M_Off || state == M_Initializing || state == M_Ready || state == M_RealTime || state == M_WaitingForLateSlaves || state == M_SafeStop || state == M_Fault -> refuse()
        fi
    :: event == ME_StartUnarmed ->
        if
        :: state == M_Off || state == M_Initializing || state == M_Ready || state == M_RealTime || state == M_WaitingForLateSlaves || state == M_SafeStop || state == M_Fault -> refuse()
        fi
    :: event == ME_Stop ->
        if
        :: state == M_Off || state == M_SafeStop || state == M_Fault -> stay(MA_None)
        :: state == M_Initializing -> go(M_Off, MA_EndSequence)
        :: state == M_Ready -> go(M_Off, MA_ForgetInitialization)
        :: state == M_RealTime || state == M_WaitingForLateSlaves -> go(M_Off, MA_EndCycles)
        fi
    :: event == ME_SafeStop ->
        if
        :: state == M_Off || state == M_SafeStop || state == M_Fault -> stay(MA_None)
        :: state == M_Initializing -> go(M_Off, MA_EndSequence)
        :: state == M_Ready -> go(M_Off, MA_ForgetInitialization)
        :: state == M_RealTime || state == M_WaitingForLateSlaves -> go(M_SafeStop, MA_MakeCyclesSafe)
        fi
    :: event == ME_Reset ->
        if
        :: state == M_Off -> stay(MA_None)
        :: state == M_Initializing || state == M_Ready || state == M_RealTime || state == M_WaitingForLateSlaves -> refuse()
        :: state == M_SafeStop || state == M_Fault -> go(M_Off, MA_Unlatch)
        fi
    :: event == ME_ResetTooEarly ->
        if
        :: state == M_Off -> stay(MA_None)
        :: state == M_Initializing || state == M_Ready || state == M_RealTime || state == M_WaitingForLateSlaves || state == M_SafeStop || state == M_Fault -> refuse()
        fi
    :: event == ME_Listen ->
        if
        :: state == M_Off || state == M_Ready || state == M_Fault -> stay(MA_None)
        :: state == M_Initializing || state == M_RealTime || state == M_WaitingForLateSlaves || state == M_SafeStop -> refuse()
        fi
    :: event == ME_AddNode ->
        if
        :: state == M_Off -> stay(MA_None)
        :: state == M_Initializing || state == M_RealTime || state == M_WaitingForLateSlaves || state == M_SafeStop || state == M_Fault -> refuse()
        :: state == M_Ready -> go(M_Off, MA_ForgetInitialization)
        fi
    :: event == ME_End ->
        if
        :: state == M_Off || state == M_Fault -> stay(MA_None)
        :: state == M_Initializing -> go(M_Off, MA_EndSequence)
        :: state == M_Ready -> go(M_Off, MA_ForgetInitialization)
        :: state == M_RealTime || state == M_WaitingForLateSlaves -> go(M_Off, MA_EndCycles)
        :: state == M_SafeStop -> stay(MA_EndCycles)
        fi
    :: event == ME_StatesInitialized ->
        if
        :: state == M_Off || state == M_Ready || state == M_RealTime || state == M_WaitingForLateSlaves || state == M_SafeStop || state == M_Fault -> ignore()
        :: state == M_Initializing -> go(M_Ready, MA_None)
        fi
    :: event == ME_CyclesStarted ->
        if
        :: state == M_Off || state == M_Ready || state == M_RealTime || state == M_WaitingForLateSlaves || state == M_SafeStop || state == M_Fault -> ignore()
        :: state == M_Initializing -> go(M_RealTime, MA_None)
        fi
    :: event == ME_SequenceFailed ->
        if
        :: state == M_Off || state == M_Ready || state == M_RealTime || state == M_WaitingForLateSlaves || state == M_SafeStop || state == M_Fault -> ignore()
        :: state == M_Initializing -> go(M_Off, MA_EndSequence)
        fi
    :: event == ME_ThreadFailed ->
        if
        :: state == M_Off || state == M_Ready || state == M_RealTime || state == M_WaitingForLateSlaves || state == M_SafeStop || state == M_Fault -> ignore()
        :: state == M_Initializing -> go(M_Fault, MA_EndSequence)
        fi
    :: event == ME_ServerListens ->
        if
        :: state == M_Off || state == M_Ready -> stay(MA_None)
        :: state == M_Initializing || state == M_RealTime || state == M_WaitingForLateSlaves || state == M_SafeStop -> ignore()
        :: state == M_Fault -> go(M_Off, MA_None)
        fi
    :: event == ME_ServerFailed ->
        if
        :: state == M_Off || state == M_Ready -> go(M_Fault, MA_ForgetInitialization)
        :: state == M_Initializing || state == M_RealTime || state == M_WaitingForLateSlaves || state == M_SafeStop -> ignore()
        :: state == M_Fault -> stay(MA_None)
        fi
    :: event == ME_NodeJoined ->
        if
        :: state == M_Off || state == M_Initializing || state == M_SafeStop || state == M_Fault -> stay(MA_None)
        :: state == M_Ready -> go(M_Off, MA_ForgetInitialization)
        :: state == M_RealTime || state == M_WaitingForLateSlaves -> stay(MA_LetJoin)
        fi
    :: event == ME_ListenerJoined ->
        if
        :: state == M_Off || state == M_Initializing || state == M_Fault -> stay(MA_None)
        :: state == M_Ready || state == M_RealTime || state == M_WaitingForLateSlaves || state == M_SafeStop -> stay(MA_LetJoin)
        fi
    :: event == ME_NodeLeft ->
        if
        :: state == M_Off || state == M_Initializing || state == M_RealTime || state == M_WaitingForLateSlaves || state == M_SafeStop || state == M_Fault -> stay(MA_None)
        :: state == M_Ready -> go(M_Off, MA_ForgetInitialization)
        fi
    :: event == ME_CriticalNodeLeft ->
        if
        :: state == M_Off || state == M_Initializing || state == M_SafeStop || state == M_Fault -> stay(MA_None)
        :: state == M_Ready -> go(M_Off, MA_ForgetInitialization)
        :: state == M_RealTime || state == M_WaitingForLateSlaves -> go(M_SafeStop, MA_MakeCyclesSafe)
        fi
    :: event == ME_NodeFailed ->
        if
        :: state == M_Off || state == M_Ready || state == M_SafeStop || state == M_Fault -> ignore()
        :: state == M_Initializing -> go(M_Off, MA_EndSequence)
        :: state == M_RealTime || state == M_WaitingForLateSlaves -> go(M_Off, MA_EndCycles)
        fi
    :: event == ME_CriticalNodeFailed ->
        if
        :: state == M_Off || state == M_Ready || state == M_SafeStop || state == M_Fault -> ignore()
        :: state == M_Initializing -> go(M_Off, MA_EndSequence)
        :: state == M_RealTime || state == M_WaitingForLateSlaves -> go(M_SafeStop, MA_MakeCyclesSafe)
        fi
    :: event == ME_WaitBegan ->
        if
        :: state == M_Off || state == M_Initializing || state == M_Ready || state == M_WaitingForLateSlaves || state == M_SafeStop || state == M_Fault -> ignore()
        :: state == M_RealTime -> go(M_WaitingForLateSlaves, MA_None)
        fi
    :: event == ME_WaitEnded ->
        if
        :: state == M_Off || state == M_Initializing || state == M_Ready || state == M_RealTime || state == M_SafeStop || state == M_Fault -> ignore()
        :: state == M_WaitingForLateSlaves -> go(M_RealTime, MA_None)
        fi
    :: event == ME_CyclesTripped ->
        if
        :: state == M_Off || state == M_Initializing || state == M_Ready || state == M_SafeStop || state == M_Fault -> ignore()
        :: state == M_RealTime || state == M_WaitingForLateSlaves -> go(M_SafeStop, MA_LatchReason)
        fi
    :: event == ME_CycleLimitReached ->
        if
        :: state == M_Off || state == M_Initializing || state == M_Ready || state == M_SafeStop || state == M_Fault -> ignore()
        :: state == M_RealTime || state == M_WaitingForLateSlaves -> go(M_Off, MA_EndCycles)
        fi
    :: event == ME_OverrunStop ->
        if
        :: state == M_Off || state == M_Initializing || state == M_Ready || state == M_SafeStop || state == M_Fault -> ignore()
        :: state == M_RealTime || state == M_WaitingForLateSlaves -> go(M_Off, MA_EndCycles)
        fi
    fi
}

#define N_Disconnected 0
#define N_Connecting 1
#define N_Registering 2
#define N_Rejected 3
#define N_Registered 4
#define N_Initializing 5
#define N_Ready 6
#define N_RealTime 7
#define N_SafeStop 8
#define N_Fault 9

#define NE_Connect 0
#define NE_Retry 1
#define NE_Leave 2
#define NE_AddedLocally 3
#define NE_Connected 4
#define NE_ConnectionLost 5
#define NE_HelloCame 6
#define NE_Accepted 7
#define NE_ChannelAttached 8
#define NE_Refused 9
#define NE_MasterEnded 10
#define NE_OutputsWanted 11
#define NE_ValuesCame 12
#define NE_InitializationFailed 13
#define NE_PhaseStarted 14
#define NE_PhaseStopped 15
#define NE_ToldSafeStop 16
#define NE_WatchdogTimedOut 17
#define NE_CodeFailed 18

#define NA_None 0
#define NA_OpenConnection 1
#define NA_CloseConnection 2
#define NA_CloseAndRetry 3
#define NA_Greet 4
#define NA_Proceed 5
#define NA_TellRegistered 6
#define NA_GiveOutputs 7
#define NA_TakeValues 8
#define NA_StartCycles 9
#define NA_EndCycles 10

inline nodeTable(state, event)
{
    if
    :: event == NE_Connect ->
        if
        :: state == N_Disconnected || state == N_Rejected || state == N_SafeStop || state == N_Fault -> go(N_Connecting, NA_OpenConnection)
        :: state == N_Connecting || state == N_Registering || state == N_Registered || state == N_Initializing || state == N_Ready || state == N_RealTime -> refuse()
        fi
    :: event == NE_Retry ->
        if
        :: state == N_Disconnected || state == N_Rejected || state == N_SafeStop || state == N_Fault -> go(N_Connecting, NA_OpenConnection)
        :: state == N_Connecting || state == N_Registering || state == N_Registered || state == N_Initializing || state == N_Ready || state == N_RealTime -> ignore()
        fi
    :: event == NE_Leave ->
        if
        :: state == N_Disconnected -> stay(NA_CloseConnection)
        :: state == N_Connecting || state == N_Registering || state == N_Rejected || state == N_Registered || state == N_Initializing || state == N_Ready || state == N_RealTime || state == N_SafeStop || state == N_Fault -> go(N_Disconnected, NA_CloseConnection)
        fi
    :: event == NE_AddedLocally ->
        if
        :: state == N_Disconnected -> go(N_Registered, NA_None)
        :: state == N_Connecting || state == N_Registering || state == N_Rejected || state == N_Registered || state == N_Initializing || state == N_Ready || state == N_RealTime || state == N_SafeStop || state == N_Fault -> refuse()
        fi
    :: event == NE_Connected ->
        if
        :: state == N_Disconnected || state == N_Registering || state == N_Rejected || state == N_Registered || state == N_Initializing || state == N_Ready || state == N_RealTime || state == N_SafeStop || state == N_Fault -> ignore()
        :: state == N_Connecting -> go(N_Registering, NA_Greet)
        fi
    :: event == NE_ConnectionLost ->
        if
        :: state == N_Disconnected || state == N_Rejected -> ignore()
        :: state == N_Connecting || state == N_Registering || state == N_Registered || state == N_Initializing || state == N_Ready -> go(N_Disconnected, NA_CloseAndRetry)
        :: state == N_RealTime -> go(N_SafeStop, NA_CloseAndRetry)
        :: state == N_SafeStop || state == N_Fault -> stay(NA_CloseAndRetry)
        fi
    :: event == NE_HelloCame ->
        if
        :: state == N_Disconnected || state == N_Connecting || state == N_Rejected || state == N_Registered || state == N_Initializing || state == N_Ready || state == N_RealTime || state == N_SafeStop || state == N_Fault -> refuse()
        :: state == N_Registering -> stay(NA_Proceed)
        fi
    :: event == NE_Accepted ->
        if
        :: state == N_Disconnected || state == N_Connecting || state == N_Rejected || state == N_Registered || state == N_Initializing || state == N_Ready || state == N_RealTime || state == N_SafeStop || state == N_Fault -> refuse()
        :: state == N_Registering -> stay(NA_Proceed)
        fi
    :: event == NE_ChannelAttached ->
        if
        :: state == N_Disconnected || state == N_Connecting || state == N_Rejected || state == N_Registered || state == N_Initializing || state == N_Ready || state == N_RealTime || state == N_SafeStop || state == N_Fault -> refuse()
        :: state == N_Registering -> go(N_Registered, NA_TellRegistered)
        fi
    :: event == NE_Refused ->
        if
        :: state == N_Disconnected || state == N_Rejected -> ignore()
        :: state == N_Connecting || state == N_Registering || state == N_Registered || state == N_Initializing || state == N_Ready || state == N_RealTime || state == N_SafeStop || state == N_Fault -> go(N_Rejected, NA_CloseAndRetry)
        fi
    :: event == NE_MasterEnded ->
        if
        :: state == N_Disconnected || state == N_Rejected -> ignore()
        :: state == N_Connecting || state == N_Registering || state == N_Registered || state == N_Initializing || state == N_Ready || state == N_RealTime || state == N_SafeStop || state == N_Fault -> go(N_Disconnected, NA_CloseAndRetry)
        fi
    :: event == NE_OutputsWanted ->
        if
        :: state == N_Disconnected || state == N_Connecting || state == N_Registering || state == N_Rejected || state == N_RealTime || state == N_SafeStop -> refuse()
        :: state == N_Registered || state == N_Ready || state == N_Fault -> go(N_Initializing, NA_GiveOutputs)
        :: state == N_Initializing -> stay(NA_GiveOutputs)
        fi
    :: event == NE_ValuesCame ->
        if
        :: state == N_Disconnected || state == N_Connecting || state == N_Registering || state == N_Rejected || state == N_RealTime || state == N_SafeStop || state == N_Fault -> refuse()
        :: state == N_Registered || state == N_Initializing -> go(N_Ready, NA_TakeValues)
        :: state == N_Ready -> stay(NA_TakeValues)
        fi
    :: event == NE_InitializationFailed ->
        if
        :: state == N_Disconnected || state == N_Connecting || state == N_Registering || state == N_Rejected || state == N_RealTime || state == N_SafeStop || state == N_Fault -> ignore()
        :: state == N_Registered -> stay(NA_None)
        :: state == N_Initializing || state == N_Ready -> go(N_Registered, NA_None)
        fi
    :: event == NE_PhaseStarted ->
        if
        :: state == N_Disconnected || state == N_Connecting || state == N_Registering || state == N_Rejected || state == N_Initializing || state == N_RealTime || state == N_SafeStop || state == N_Fault -> refuse()
        :: state == N_Registered || state == N_Ready -> go(N_RealTime, NA_StartCycles)
        fi
    :: event == NE_PhaseStopped ->
        if
        :: state == N_Disconnected || state == N_Connecting || state == N_Registering || state == N_Rejected -> ignore()
        :: state == N_Registered -> stay(NA_None)
        :: state == N_Initializing || state == N_Ready -> go(N_Registered, NA_None)
        :: state == N_RealTime || state == N_SafeStop -> go(N_Registered, NA_EndCycles)
        :: state == N_Fault -> stay(NA_EndCycles)
        fi
    :: event == NE_ToldSafeStop ->
        if
        :: state == N_Disconnected || state == N_Connecting || state == N_Registering || state == N_Rejected || state == N_Registered || state == N_Initializing || state == N_Ready || state == N_SafeStop || state == N_Fault -> ignore()
        :: state == N_RealTime -> go(N_SafeStop, NA_None)
        fi
    :: event == NE_WatchdogTimedOut ->
        if
        :: state == N_Disconnected || state == N_Connecting || state == N_Registering || state == N_Rejected || state == N_Registered || state == N_Initializing || state == N_Ready -> ignore()
        :: state == N_RealTime -> go(N_SafeStop, NA_CloseAndRetry)
        :: state == N_SafeStop || state == N_Fault -> stay(NA_CloseAndRetry)
        fi
    :: event == NE_CodeFailed ->
        if
        :: state == N_Disconnected || state == N_Connecting || state == N_Registering || state == N_Rejected -> ignore()
        :: state == N_Registered || state == N_Initializing || state == N_Ready || state == N_RealTime || state == N_SafeStop -> go(N_Fault, NA_None)
        :: state == N_Fault -> stay(NA_None)
        fi
    fi
}
