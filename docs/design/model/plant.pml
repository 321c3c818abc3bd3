/* SPDX-License-Identifier: Apache-2.0
   A plant with a master, a critical node (0), another node (1) and an operator. README.md beside this
   file says what is modelled; check.py runs it. */

#include "tables.pml"

/* ---- switches: 1 as it should be; README.md says which of them the product has ---- */

#ifndef MANIFEST            /* the master refuses to begin without its critical node */
#define MANIFEST 1
#endif
#ifndef SAFE_ANSWER_TRIPS   /* a critical node that is safe by itself stops the plant from the cycle thread */
#define SAFE_ANSWER_TRIPS 1
#endif
#ifndef FAULT_TRIPS         /* so does a critical node whose code has failed */
#define FAULT_TRIPS 1
#endif
#ifndef WATCHDOG_FIRST      /* a node that was stopped looks at its watchdog before it takes a frame */
#define WATCHDOG_FIRST 1
#endif
#ifndef LEASE_IN_CYCLE      /* the cycle thread keeps the deadlines of leases */
#define LEASE_IN_CYCLE 1
#endif
#ifndef RESET_NAMES_FAULT   /* a reset is for the safe stop that its sender has seen */
#define RESET_NAMES_FAULT 1
#endif

/* ---- size of the world: check.py chooses it for each run ---- */

#ifndef FAULTS              /* that nodes, connections and the master may have in a run; cables, kills, hangs */
#define FAULTS 1
#endif
#ifndef COMMANDS            /* of the operator in a run */
#define COMMANDS 3
#endif
#ifndef LOSS                /* 0: no frame is lost; 1: frames may be lost; 2: lost and delayed */
#define LOSS 1
#endif
#ifndef CODE_FAILS          /* whether code of nodes may throw, at the cost of one fault */
#define CODE_FAILS 0
#endif
#ifndef THREAD_FAILS        /* whether the cycle thread may fail to start */
#define THREAD_FAILS 0
#endif
#ifndef WAITS               /* whether the master waits for late answers of node 1 */
#define WAITS 0
#endif
#ifndef ARMING              /* whether a start has to be armed */
#define ARMING 0
#endif
#ifndef LEASE               /* whether the operator may take over a signal */
#define LEASE 0
#endif
#ifndef EVICTS              /* whether the operator may evict nodes and admit them again */
#define EVICTS 0
#endif
#ifndef MASTER_FAULTS
#define MASTER_FAULTS 1
#endif
#ifndef HELPFUL             /* the operator wants motion, and does what leads to it; nobody is impatient */
#define HELPFUL 0
#endif
#ifndef PROMPT              /* 1: nodes that run read messages and reports before the next cycle; 0: at any time */
#define PROMPT 0
#endif
#ifndef PRESENCE            /* what is counted for the properties: cycles without the critical node */
#define PRESENCE 0
#endif
#ifndef SILENCE             /* and ticks of a node without a master */
#define SILENCE 0
#endif
#ifndef SINGLE_STOP         /* for the formula about Stop: the operator sends it once, and nothing after it */
#define SINGLE_STOP 0
#endif

/* ---- limits, in cycles; smaller than those of the product, with the same relations ---- */

#define LateCosts    2
#ifndef BucketLimit
#define BucketLimit  4      /* two late answers in a row */
#endif
#ifndef WatchdogTime
#define WatchdogTime 3
#endif
#define GapLimit     2
#define LongestWait  2
#define LeaseTime    2
#ifndef Typed
#define Typed        1      /* commands that are on their way at a time */
#endif
#define Queue        4      /* messages that a connection holds; one that is full ends */

/* What is promised, in cycles. */
/* Cycles of node 1 without the critical one: late ones, and one on the way. */
#define MostWithout  (BucketLimit / LateCosts + 1)
#define MostMotion   (2 * WatchdogTime + 1)   /* of a node without a master: one frame may be delayed */
#define MostLease    (LeaseTime + 1)

#define isCritical(n) (n == 0)
#define runs(n)       (alive[n] && !hung[n])
#define masterRuns    (masterAlive && !masterHung)
#define both(check)   (check(0) && check(1))

/* ---- messages of the control channel ---- */

#define Attached           1   /* to the node: Registered and CyclicChannelAttached */
#define Rejected           2
#define SendOutputs        3   /* SendYourInitialOutputStates */
#define Values             4   /* InitializeWithValues */
#define NotInitialized     5   /* StatesInitialized with ok: false */
#define Started            6   /* RealTimeStarted */
#define Stopped            7   /* RealTimeStopped */
#define Register           1   /* to the master */
#define Outputs            2   /* ReceiveMyInitialOutputStates */
#define Initialized        3
#define Ready              4   /* RealTimeReady */
#define NodeFault          5

chan toNode[2] = [Queue] of { byte };
chan toMaster[2] = [Queue] of { byte };
bool linked[2];          /* a TCP connection that still carries messages */

/* ---- the master: thread of Qt ---- */

bool masterAlive = true;
bool masterHung;
byte master = M_Off;     /* its state */
bool armed;
byte culprit;            /* of a safe stop, who has to be well again before a reset; 0: none, else its number + 1 */
bool mustReturn;

#define NoStep     0     /* SequenceStep::Kind */
#define Collect    1
#define Distribute 2
#define Start      3
byte step;
bool startAfterwards;

#define Idle           0 /* NodeSession::Stage */
#define GivingOutputs  1
#define OutputsGiven   2
#define Initializing   3
#define IsInitialized  4
#define Starting       5
#define Running        6
byte stage[2];
bool attached[2];        /* there is a session */
bool halfOpen[2];        /* it belongs to a connection that the node has given up, which the master does not know yet */
bool stranger[2];        /* the process is another one than that of the session */
bool awaited[2];         /* the step waits for it */
#if EVICTS
bool evicted[2];
#define isEvicted(n) evicted[n]
#else
#define isEvicted(n) false
#endif

/* ---- the master: cycle thread, and what it shares with that of Qt ---- */

bool cycles;             /* they run */
bool tripped;            /* SafetyGuard: safe frames from the next cycle on */
byte tripReport;         /* on its way to the thread of Qt; 0: none, 1: the master itself, else a node's number + 2 */
bool faultReport[2];     /* NodeFaulted, likewise */
bool roster[2];
byte bucket[2];
bool knownFailed[2];
byte gap;                /* ticks that the master has stood still */
bool waiting;            /* for an answer of node 1 */
byte waited;
bool computed;           /* node 1 has computed the cycle that the master waits in */

/* ---- the nodes ---- */

bool alive[2] = true;
bool hung[2];
byte node[2] = N_Disconnected;
bool connection[2];      /* its end of the control channel */
bool inPhase[2];         /* its cycle thread runs */
bool safe[2];            /* NodeRuntime: no outputs but the safe ones */
bool failed[2];
bool heard[2];           /* a frame of this phase */
byte quiet[2];           /* ticks since the last one */
bool toldSafe[2];        /* reports of the cycle thread to that of Qt */
bool watchdogReport[2];
bool codeReport[2];
bool closing[2];         /* closeAfterWatchdog() is to come */

#define NoFrame   0
#define Motion    1      /* Inputs without the flag SafeStop */
#define Rest      2      /* with it */
byte frame[2];           /* on the way, or in the queue of the kernel */

/* ---- the operator ---- */

#define C_Initialize 1
#define C_Arm        2
#define C_Start      3
#define C_Stop       4
#define C_SafeStop   5
#define C_Reset      6
#define C_TakeLease  7   /* with a value */
#define C_SetSignal  8
#define C_Release    9
#define C_Ask        10  /* anything else: renews leases */
#define C_Evict      11  /* node 0 */
#define C_EvictOther 12  /* node 1 */
#define C_Admit      13  /* both */
chan toOperatorPort = [Typed] of { byte, bool };
byte commands = COMMANDS;
byte faults = FAULTS;

#define Free 0
#define Held 1
#define Lost 2
byte lease;
byte leaseAge;           /* cycles since the master has read a message of the holder */
bool moved;              /* the signal has the value of the holder, not its neutral one */
#define NoValue 0
#define Moved   1
#define Neutral 2
byte setting;            /* newest value in the ring between the threads of the master */
bool holderGone;

/* ---- for the properties only ---- */

bool permitted;          /* a person has started, and the cycles of that start have not begun yet */
bool latched;            /* the master was in SafeStop, and no person has reset it */
bool mayNotMove[2];      /* safe in this phase */
byte without;            /* cycles in which node 1 moved, since the critical node did */
byte alone[2];           /* ticks since the master has sent a frame for motion */
byte unheard;             /* cycles since the master has read a message of the holder */
bool stopSent;
bool stopDone;

/* ---- scratch: set before it is used, in one atomic step. Such a step begins with its guard: it never waits
   in the middle, where others would change the scratch. ---- */

hidden byte verdict;
hidden byte action;
hidden byte event = 255;   /* NoEvent, between two atomic steps */
hidden byte joiner = 2;    /* NoNode, likewise */
hidden byte follows = 2;
hidden byte k;
hidden byte who;
hidden byte flag;
hidden byte hears[2];
hidden byte inTime[2];
hidden byte moves[2];

#define NoEvent 255
#define NoNode  2

/* ================================ control channel ================================ */

inline flush(channel)
{
    do
    :: nempty(channel) -> channel ? _
    :: empty(channel) -> break
    od
}

/* A peer that reads nothing loses its connection when its queue is full. */
inline sendToNode(n, what)
{
    if
    :: attached[n] && !halfOpen[n] && linked[n] && len(toNode[n]) < Queue -> toNode[n] ! what
    :: attached[n] && !halfOpen[n] && linked[n] && len(toNode[n]) == Queue -> linked[n] = false
    :: else
    fi
}

inline sendToMaster(n, what)
{
    if
    :: linked[n] && len(toMaster[n]) < Queue -> toMaster[n] ! what
    :: linked[n] && len(toMaster[n]) == Queue -> linked[n] = false
    :: else
    fi
}

/* ================================ the master ================================ */

inline renewRoster(n)
{
    roster[n] = true;
    bucket[n] = 0;
    knownFailed[n] = false
}

/* RealTimePhase::end() and what follows it: the last reports are read in a state that ignores them. */
inline endCycles()
{
    if
    :: cycles ->
        cycles = false;
        waiting = false; waited = 0; gap = 0;
        tripped = false; tripReport = 0;
        for (k : 0 .. 1) {
            faultReport[k] = false;
            roster[k] = false; bucket[k] = 0; knownFailed[k] = false;
            if
            :: stage[k] != Idle -> sendToNode(k, Stopped)
            :: else
            fi;
            stage[k] = Idle
        };
        if
        :: setting != NoValue -> moved = (setting == Moved); setting = NoValue
        :: else
        fi
    :: else
    fi
}

inline endStep()
{
    step = NoStep;
    awaited[0] = false;
    awaited[1] = false
}

/* JoinSequence::begin() */
inline join(n)
{
    stage[n] = GivingOutputs;
    sendToNode(n, SendOutputs)
}

/* StartSequence::begin(): nodes that have not come so far join later. */
inline startNodes()
{
    step = Start;
    for (k : 0 .. 1) {
        awaited[k] = attached[k] && stage[k] == IsInitialized;
        if
        :: awaited[k] -> stage[k] = Starting; sendToNode(k, Started)
        :: else
        fi
    }
}

/* StartSequence::startCycles() */
inline startCycles()
{
    endStep();
    cycles = true;
    tripped = false;
    for (k : 0 .. 1) {
        if
        :: attached[k] && stage[k] == Running -> renewRoster(k)
        :: else
        fi
    };
    without = 0;
    event = ME_CyclesStarted
}

#define hasAnswered(n) (!awaited[n] || stage[n] >= (step == Collect -> OutputsGiven \
                                                    : (step == Start -> Running : IsInitialized)))

/* NeededNodes::missingText(), as QPlcMasterNodePrivate asks before an initialization, before a
   start, and between both. */
#if MANIFEST
#define isComplete (stage[0] >= IsInitialized)
#define mayBegin (attached[0] && (master != M_Ready || isComplete))
#else
#define isComplete true
#define mayBegin true
#endif

/* The step at hand is complete: InitializeSequence::advance(), StartSequence::advance(). */
inline advance()
{
    if
    :: step == Collect ->
        step = Distribute;
        for (k : 0 .. 1) {
            if
            :: awaited[k] -> stage[k] = Initializing; sendToNode(k, Values)
            :: else
            fi
        }
    :: step == Distribute ->
        endStep();
        if
        :: startAfterwards && isComplete -> startNodes()
        :: startAfterwards && !isComplete -> event = ME_SequenceFailed
        :: !startAfterwards -> event = ME_StatesInitialized
        fi
    :: step == Start ->
        if
        :: startCycles()
#if THREAD_FAILS
        :: event = ME_ThreadFailed
#endif
        fi
    fi
}

/* What the master does when an event is accepted: QPlcMasterNodePrivate::carryOut(). */
inline carryOut()
{
    if
    :: action == MA_None || action == MA_ForgetInitialization || action == MA_LatchReason
    :: action == MA_CollectOutputs || action == MA_CollectThenStart ->
        startAfterwards = (action == MA_CollectThenStart);
        step = Collect;
        for (k : 0 .. 1) {
            awaited[k] = attached[k];
            if
            :: awaited[k] -> stage[k] = GivingOutputs; sendToNode(k, SendOutputs)
            :: else
            fi
        }
    :: action == MA_StartNodes -> startNodes()
    :: action == MA_IssueToken -> armed = true
    :: action == MA_EndSequence ->
        for (k : 0 .. 1) {
            if
            :: step != Start -> sendToNode(k, NotInitialized)
            :: step == Start && stage[k] != Idle -> sendToNode(k, Stopped)
            :: else
            fi;
            stage[k] = Idle
        };
        endStep()
    :: action == MA_EndCycles || action == MA_Unlatch -> endCycles()
    :: action == MA_MakeCyclesSafe -> tripped = true
    :: action == MA_LetJoin ->
        if
        :: joiner != NoNode -> join(joiner)
        :: else
        fi
    fi
}

/* QPlcMasterNodePrivate::apply(), for `event` and for what follows from it at once. */
inline apply()
{
    do
    :: event != NoEvent ->
        k = master;
        flag = (event == ME_Start);   /* a person wants motion */
        masterTable(master, event);
        assert(event != ME_Stop || (verdict == Accepted
               && (master == M_Off || master == M_SafeStop || master == M_Fault)));   /* property 4 */
        if
        :: verdict == Accepted ->
            armed = armed && (k == master);
            permitted = permitted || flag;
            latched = (latched || master == M_SafeStop) && event != ME_Reset;
            flag = (master == M_RealTime && k == M_Initializing);
            assert(!flag || permitted);                                                /* property 3 */
            assert(!flag || !latched);                                                 /* property 3 */
            permitted = permitted && (master == M_Initializing);
            event = NoEvent;
            carryOut();
            if
            :: flag ->                /* a node that came while the others were being started joins now */
                for (k : 0 .. 1) {
                    if
                    :: cycles && attached[k] && stage[k] == Idle -> join(k)
                    :: else
                    fi
                }
            :: else
            fi
        :: else -> event = NoEvent
        fi
    :: event == NoEvent && step != NoStep && both(hasAnswered) -> advance()
    :: event == NoEvent && !(step != NoStep && both(hasAnswered)) && follows != NoNode ->
        admit(follows);
        follows = NoNode
    :: else -> break
    od;
    if
    :: master != M_SafeStop -> culprit = 0; mustReturn = false
    :: else
    fi;
    /* While cycles run for motion, the critical node takes part, as far as the master knows. */
    assert(!(cycles && !tripped) || (attached[0] && stage[0] == Running && roster[0]));   /* property 1 */
    assert(cycles == (master == M_RealTime || master == M_WaitingForLateSlaves || master == M_SafeStop));
    assert(master != M_SafeStop || tripped)
}

/* MasterFaults::blame() */
inline blame(whom, hasToReturn)
{
    if
    :: master != M_SafeStop -> culprit = whom; mustReturn = hasToReturn
    :: else
    fi
}

/* QPlcMasterNodePrivate::nodeLost(): sets the event that follows. */
inline nodeLost(n)
{
    if
    :: awaited[n] && step != NoStep -> event = ME_SequenceFailed
    :: !(awaited[n] && step != NoStep) && stage[n] == Running && isCritical(n) ->
        blame(n + 1, true);
        event = ME_CriticalNodeLeft
    :: else -> event = ME_NodeLeft
    fi;
    if
    :: !halfOpen[n] -> linked[n] = false
    :: else
    fi;
    attached[n] = false; halfOpen[n] = false; stranger[n] = false; awaited[n] = false;
    stage[n] = Idle; roster[n] = false; bucket[n] = 0; knownFailed[n] = false
}

inline nodeFailed(n)
{
    blame(n + 1, false);
    event = (isCritical(n) && attached[n] -> ME_CriticalNodeFailed : ME_NodeFailed)
}

/* MasterFaults::remainingCause() */
#define causeRemains (master == M_SafeStop && culprit != 0 \
                      && (attached[culprit - 1] -> bucket[culprit - 1] > 0 : mustReturn))

inline answer(n, what)
{
    if
    :: ((stage[n] == GivingOutputs && what == Outputs) || (stage[n] == Initializing && what == Initialized)
        || (stage[n] == Starting && what == Ready)) ->
        stage[n] = stage[n] + 1;
        if
        :: cycles ->                  /* JoinSequence::goOn() */
            if
            :: stage[n] == OutputsGiven -> stage[n] = Initializing; sendToNode(n, Values)
            :: stage[n] == IsInitialized -> stage[n] = Starting; sendToNode(n, Started)
            :: stage[n] == Running -> renewRoster(n)
            fi
        :: else                       /* apply() sees that the step is complete */
        fi
    :: else                           /* not asked for: refused, and nothing changes */
    fi
}

inline messageOfNode(n, what)
{
    if
    :: what == Register ->
        if
        :: isEvicted(n) || (attached[n] && stranger[n]) ->    /* or the name is in use */
            if
            :: len(toNode[n]) < Queue -> toNode[n] ! Rejected
            :: len(toNode[n]) == Queue
            fi;
            linked[n] = false
        :: !isEvicted(n) && attached[n] && !stranger[n] -> nodeLost(n); follows = n    /* MasterServer::replace() */
        :: !isEvicted(n) && !attached[n] -> follows = n
        fi
    :: what == NodeFault ->
        if
        :: attached[n] && cycles && stage[n] != Running -> nodeLost(n)    /* it has failed to join */
        :: attached[n] && !(cycles && stage[n] != Running) -> nodeFailed(n)
        :: !attached[n]
        fi
    :: what == Outputs || what == Initialized || what == Ready -> answer(n, what)
    fi
}

inline admit(n)
{
    attached[n] = true; halfOpen[n] = false; stranger[n] = false;
    stage[n] = Idle; awaited[n] = false;
    sendToNode(n, Attached);
    joiner = n;
    event = ME_NodeJoined
}

#define startOfAll (mayBegin -> ME_Start : ME_StartIncomplete)
#if ARMING
#define startEvent (armed -> startOfAll : ME_StartUnarmed)
#else
#define startEvent startOfAll
#endif
#if RESET_NAMES_FAULT
#define mayReset(seen) (master != M_SafeStop || seen)
#else
#define mayReset(seen) true
#endif

inline command(what, seen)
{
    if
    :: lease == Held -> leaseAge = 0    /* every message renews it; a cycle thread that has ended it did so before */
    :: else
    fi;
    unheard = 0;
    if
    :: what == C_Initialize -> event = (mayBegin -> ME_Initialize : ME_InitializeIncomplete)
    :: what == C_Arm -> event = ME_Arm
    :: what == C_Start -> event = startEvent
    :: what == C_Stop -> event = ME_Stop; stopDone = true
    :: what == C_SafeStop -> blame(0, false); event = ME_SafeStop
    :: what == C_Reset && mayReset(seen) ->
        event = (causeRemains -> ME_ResetTooEarly : ME_Reset);
        assert(master != M_SafeStop || seen)                                           /* property 3 */
    :: what == C_TakeLease -> lease = Held; leaseAge = 0; set(Moved)
    :: what == C_SetSignal && lease == Held -> set(Moved)
    :: what == C_Release -> lease = Free
#if EVICTS
    :: what == C_Evict || what == C_EvictOther ->    /* MasterEvictions::evict() */
        who = what - C_Evict;
        evicted[who] = true;
        if
        :: attached[who] -> sendToNode(who, Rejected); nodeLost(who)
        :: !attached[who]
        fi
    :: what == C_Admit -> evicted[0] = false; evicted[1] = false
#endif
    :: else                             /* refused, or a question */
    fi
}

/* MasterCycle::setValues() */
inline set(what)
{
    if
    :: cycles -> setting = what
    :: !cycles -> moved = (what == Moved)
    fi
}

#if HELPFUL
/* Time is long compared with messages: a timer ends when nothing else can happen at the node that it waits for. */
#define isSlow(n) (awaited[n] && stage[n] < (step == Collect -> OutputsGiven \
                                             : (step == Start -> Running : IsInitialized)) \
                   && (!runs(n) || !linked[n] || halfOpen[n] || (empty(toNode[n]) && empty(toMaster[n]) && !closing[n] \
                       && !toldSafe[n] && !watchdogReport[n] && !codeReport[n])))
#define timeIsUp (step != NoStep && !isGone(0) && !isGone(1) && (isSlow(0) || isSlow(1)))
#define newsFirst(n) (!isGone(n))
#else
#define timeIsUp (step != NoStep)
#define newsFirst(n) true
#endif
#define isGone(n) (attached[n] && (halfOpen[n] || !linked[n]))

/* The thread of Qt in the master: one message, report or timer after the other, at any time. */
active proctype Master()
{
    byte what;
    bool seen;

    do
    :: atomic {
        if
        /* a node or its machine closed the connection, or it was silent for too long */
        :: masterRuns && (isGone(0) || isGone(1)) ->
            if
            :: isGone(0) -> who = 0
            :: isGone(1) -> who = 1
            fi;
            nodeLost(who)
        :: masterRuns && ((newsFirst(0) && nempty(toMaster[0])) || (newsFirst(1) && nempty(toMaster[1]))) ->
            if
            :: newsFirst(0) && nempty(toMaster[0]) -> who = 0
            :: newsFirst(1) && nempty(toMaster[1]) -> who = 1
            fi;
            toMaster[who] ? what;
            messageOfNode(who, what)
        :: masterRuns && nempty(toOperatorPort) -> toOperatorPort ? what, seen; command(what, seen)
        :: masterRuns && timeIsUp -> event = ME_SequenceFailed
        :: masterRuns && armed -> armed = false    /* 5 s are over */
        /* reports of the cycle thread */
        :: masterRuns && tripReport != 0 ->
            blame(tripReport - 1, false);
            tripReport = 0;
            event = ME_CyclesTripped
        :: masterRuns && (faultReport[0] || faultReport[1]) ->
            who = (faultReport[0] -> 0 : 1);
            faultReport[who] = false;
            nodeFailed(who)
#if WAITS
        :: masterRuns && waiting && master == M_RealTime -> event = ME_WaitBegan
        :: masterRuns && cycles && !waiting && master == M_WaitingForLateSlaves -> event = ME_WaitEnded
#endif
#if LEASE
        :: masterRuns && lease == Held && (holderGone || (!LEASE_IN_CYCLE && leaseAge >= LeaseTime)) ->
            lease = Lost; leaseAge = 0; set(Neutral)
#endif
        fi;
        apply();
        assert(!(isEvicted(0) && attached[0]) && !(isEvicted(1) && attached[1]));      /* property 6 */
        what = 0; seen = false;
        joiner = NoNode
       }
    od
}

/* ================================ a node ================================ */

/* QPlcSlaveNodePrivate::endPhase() */
inline endPhase(n)
{
    inPhase[n] = false;
    safe[n] = true;
    heard[n] = false; quiet[n] = 0; closing[n] = false; failed[n] = false;
    frame[n] = NoFrame;
    mayNotMove[n] = false
}

/* QPlcSlaveNodePrivate::closeConnection() */
inline closeConnection(n)
{
    endPhase(n);
    toldSafe[n] = false; watchdogReport[n] = false; codeReport[n] = false;
    if
    :: connection[n] -> connection[n] = false; linked[n] = false; flush(toNode[n])
    :: else
    fi
}

/* QPlcSlaveNodePrivate::apply() */
inline applyNode(n)
{
    nodeTable(node[n], event);
    if
    :: verdict == Accepted ->
        if
        :: action == NA_None || action == NA_Proceed || action == NA_TellRegistered || action == NA_OpenConnection
        :: action == NA_CloseConnection -> closeConnection(n)
        :: action == NA_CloseAndRetry ->
            if
            :: event == NE_WatchdogTimedOut -> closing[n] = true
            :: else -> closeConnection(n)
            fi
        :: action == NA_Greet -> sendToMaster(n, Register)
        :: action == NA_GiveOutputs ->
            if
            :: sendToMaster(n, Outputs)
#if CODE_FAILS
            :: faults > 0 -> faults--; sendToMaster(n, NodeFault); node[n] = N_Fault
#endif
            fi
        :: action == NA_TakeValues -> sendToMaster(n, Initialized)
        :: action == NA_StartCycles ->
            inPhase[n] = true; safe[n] = false; failed[n] = false; heard[n] = false; quiet[n] = 0;
            frame[n] = NoFrame;       /* FrameDecoder::restart(): those of another phase are not taken */
            mayNotMove[n] = false;
            sendToMaster(n, Ready)
        :: action == NA_EndCycles -> endPhase(n)
        fi
    :: else
    fi
}

inline messageOfMaster(n, what)
{
    if
    :: what == Attached -> event = NE_ChannelAttached
    :: what == Rejected -> event = NE_Refused
    :: what == SendOutputs -> event = NE_OutputsWanted
    :: what == Values -> event = NE_ValuesCame
    :: what == NotInitialized -> event = NE_InitializationFailed
    :: what == Started -> event = NE_PhaseStarted
    :: what == Stopped -> event = NE_PhaseStopped
    fi
}

#define hasReports(n) (toldSafe[n] || watchdogReport[n] || codeReport[n])

/* The thread of Qt in a node. */
proctype Node(byte n)
{
    byte what;

    do
    :: atomic {
        if
        /* reports of the cycle thread: always before the next message */
        :: runs(n) && toldSafe[n] -> toldSafe[n] = false; event = NE_ToldSafeStop
        :: runs(n) && watchdogReport[n] -> watchdogReport[n] = false; event = NE_WatchdogTimedOut
        :: runs(n) && codeReport[n] ->
            codeReport[n] = false;
            sendToMaster(n, NodeFault);
            event = NE_CodeFailed
        :: runs(n) && !hasReports(n) && connection[n] && nempty(toNode[n]) ->
            toNode[n] ? what;
            messageOfMaster(n, what)
        :: runs(n) && !hasReports(n) && connection[n] && !linked[n] -> event = NE_ConnectionLost
        :: runs(n) && !hasReports(n) && closing[n] -> closeConnection(n)
        /* the pause before the next attempt is over, and the master listens */
        :: runs(n) && !connection[n] && masterAlive ->
            flush(toNode[n]); flush(toMaster[n]);
            connection[n] = true; linked[n] = true;
            halfOpen[n] = attached[n];
            event = NE_Retry
        fi;
        do
        :: event != NoEvent ->
            applyNode(n);
            event = (action == NA_OpenConnection && verdict == Accepted -> NE_Connected : NoEvent)
        :: else -> break
        od;
        what = 0
       }
    od
}

/* ================================ cycles ================================ */

/* Asks node n for a cycle. The frame is handled in this tick, later, or never. */
inline ask(n, kind)
{
    hears[n] = false;
    if
    :: roster[n] && linked[n] && !halfOpen[n] ->
        if
        :: frame[n] = kind; hears[n] = true
#if LOSS
        :: hears[n] = (frame[n] != NoFrame)    /* lost; one that was on the way arrives */
#endif
#if LOSS > 1
        :: frame[n] = kind            /* delayed; one that was on the way is lost */
#endif
        fi
    :: else ->
        if
        :: frame[n] != NoFrame -> hears[n] = true
#if LOSS > 1
        :: frame[n] != NoFrame
#endif
        :: frame[n] == NoFrame
        fi
    fi
}

/* SlaveCycle::handle(), or its watchdog. */
inline nodeCycle(n)
{
    inTime[n] = false;
    moves[n] = false;
    if
    :: !alive[n] || !inPhase[n] -> frame[n] = NoFrame
    :: alive[n] && inPhase[n] && hung[n] ->
        quiet[n] = (quiet[n] < WatchdogTime -> quiet[n] + 1 : WatchdogTime)
    :: runs(n) && inPhase[n] && hears[n] && !(WATCHDOG_FIRST && heard[n] && quiet[n] >= WatchdogTime && !safe[n]) ->
        quiet[n] = 0;
        heard[n] = true;
        if
        :: frame[n] == Rest && !safe[n] -> safe[n] = true; mayNotMove[n] = true; toldSafe[n] = true
        :: else
        fi;
        frame[n] = NoFrame;
        if
        :: !safe[n] -> moves[n] = !(WAITS && n == 1 && waiting && computed)    /* else it repeats its answer */
#if CODE_FAILS
        :: !safe[n] && faults > 0 ->
            faults--;
            failed[n] = true; safe[n] = true; mayNotMove[n] = true; codeReport[n] = true
#endif
        :: safe[n]
        fi;
        if
        :: inTime[n] = roster[n] && linked[n] && !halfOpen[n]
#if LOSS
        :: skip                       /* the answer is lost, or late */
#endif
        fi
    :: else ->
        if
        :: heard[n] && quiet[n] < WatchdogTime -> quiet[n] = quiet[n] + 1
        :: else
        fi;
        if
        :: heard[n] && quiet[n] == WatchdogTime && !safe[n] ->
            safe[n] = true; mayNotMove[n] = true; watchdogReport[n] = true
        :: heard[n] && quiet[n] == WatchdogTime && safe[n] && !closing[n] && !watchdogReport[n] ->
            watchdogReport[n] = true
        :: else
        fi
    fi;
    assert(!moves[n] || !mayNotMove[n])                                                /* property 3 */
}

inline trip(whom)
{
    if
    :: !tripped -> tripped = true; tripReport = whom
    :: else
    fi
}

/* NodeExchange::collectAnswers() and handleAnswer() */
inline judge(n)
{
    if
    :: cycles && roster[n] && inTime[n] ->
        if
        :: bucket[n] > 0 -> bucket[n] = bucket[n] - 1
        :: else
        fi;
        if
        :: failed[n] && !knownFailed[n] -> knownFailed[n] = true; faultReport[n] = true
        :: else
        fi;
        if
        :: FAULT_TRIPS && isCritical(n) && failed[n] -> trip(n + 2)
        :: SAFE_ANSWER_TRIPS && isCritical(n) && safe[n] && !failed[n] -> trip(n + 2)
        :: else
        fi
    :: cycles && roster[n] && !inTime[n] ->
        bucket[n] = (bucket[n] + LateCosts < BucketLimit -> bucket[n] + LateCosts : BucketLimit);
        if
        :: isCritical(n) && bucket[n] == BucketLimit -> trip(n + 2)
        :: else
        fi
    :: else
    fi
}

/* MasterCycle::runCycle(), its begin: limits, commands, and the requests. */
inline masterCycle()
{
    flag = tripped;                   /* what this cycle tells; whatever is found in it counts for the next one */
#if LEASE
    if
    :: lease == Held && leaseAge < LeaseTime -> leaseAge = leaseAge + 1
    :: LEASE_IN_CYCLE && lease == Held && leaseAge >= LeaseTime -> lease = Lost; leaseAge = 0; setting = Neutral
    :: else
    fi;
    if
    :: setting != NoValue -> moved = (setting == Moved); setting = NoValue
    :: else
    fi;
    if
    :: flag -> moved = false          /* SafeImage */
    :: else
    fi;
    unheard = (unheard <= MostLease -> unheard + 1 : unheard);
    assert(!moved || lease == Free || unheard <= MostLease);                            /* property 2 */
#endif
    if
    :: gap >= GapLimit -> trip(1)
    :: else
    fi;
    gap = 0;
    flag = tripped;
#if SILENCE
    for (k : 0 .. 1) {
        if
        :: roster[k] && !flag -> alone[k] = 0
        :: else
        fi
    };
#endif
    ask(0, (flag -> Rest : Motion));
    ask(1, (flag -> Rest : Motion))
}

/* Nothing is on the way, but what was sent before. */
inline noCycle()
{
    hears[0] = false; hears[1] = false;
    if
    :: frame[0] != NoFrame -> hears[0] = true
#if LOSS > 1
    :: frame[0] != NoFrame
#endif
    :: frame[0] == NoFrame
    fi;
    if
    :: frame[1] != NoFrame -> hears[1] = true
#if LOSS > 1
    :: frame[1] != NoFrame
#endif
    :: frame[1] == NoFrame
    fi
}

#define isInTime(n) (!runs(n) || !inPhase[n] || !heard[n] || safe[n] || alone[n] <= MostMotion)
#define count(counter) counter = (counter <= MostMotion -> counter + 1 : counter)

#define isReady(n) (!runs(n) || (!hasReports(n) && !closing[n] && (!connection[n] || (linked[n] && empty(toNode[n])))))

/* The cycle threads of all, from period to period. */
active proctype Clock()
{
    do
    :: atomic {
        (((masterAlive && cycles) || (alive[0] && inPhase[0]) || (alive[1] && inPhase[1]))
         && (!PROMPT || both(isReady))) ->
#if SILENCE
        for (k : 0 .. 1) {
            if
            :: alive[k] && inPhase[k] && heard[k] && !safe[k] -> count(alone[k])
            :: else -> alone[k] = 0
            fi
        };
#endif
        if
        :: masterRuns && cycles && !waiting -> masterCycle()
#if WAITS
        :: masterRuns && cycles && waiting ->
            gap = 0;
            waited = waited + 1;
            hears[0] = false; hears[1] = false;
            if
            :: roster[1] && !tripped && waited < LongestWait ->   /* asks node 1 again */
                alone[1] = 0;
                ask(1, Motion)
            :: roster[1] && !tripped && waited >= LongestWait -> trip(3); waiting = false; waited = 0
            :: else -> waiting = false; waited = 0
            fi
#endif
        :: masterAlive && masterHung && cycles ->
            gap = (gap < GapLimit -> gap + 1 : gap);
            noCycle()
        :: else -> noCycle()
        fi;
        nodeCycle(0);
        nodeCycle(1);
        if
        :: masterRuns && cycles && !waiting ->
            judge(0);
            judge(1);
#if WAITS
            if
            :: roster[1] && !inTime[1] && !tripped -> waiting = true; waited = 0
            :: else
            fi
#endif
        :: masterRuns && cycles && waiting && inTime[1] -> waiting = false; waited = 0
        :: else
        fi;
#if WAITS
        computed = waiting && (computed || moves[1]);
#endif
#if PRESENCE
        if
        :: moves[0] -> without = 0
        :: moves[1] && !moves[0] -> without = (without <= MostWithout -> without + 1 : without)
        :: else
        fi;
        assert(without <= MostWithout);                                                /* property 1 */
#endif
#if SILENCE
        assert(both(isInTime));                                                        /* property 5 */
#endif
        flag = false
       }
    od
}

/* ================================ the world ================================ */

#define inCycle(n) (roster[n] && inPhase[n] && !safe[n] && runs(n))

/* A person or a program with the rights of one. */
active proctype Operator()
{
    do
#if HELPFUL
    :: atomic { masterRuns && empty(toOperatorPort) && master == M_SafeStop && !causeRemains ->
        toOperatorPort ! C_Reset, true }
    :: atomic { (masterRuns && empty(toOperatorPort) && (master == M_Off || master == M_Ready)
                 && attached[0] && attached[1] && !isGone(0) && !isGone(1)) ->
        toOperatorPort ! C_Start, false }
    :: atomic { masterRuns && empty(toOperatorPort) && master == M_Fault -> toOperatorPort ! C_Reset, true }
#else
    :: atomic { (masterAlive && !holderGone && commands > 0 && len(toOperatorPort) < Typed
                 && !(SINGLE_STOP && stopSent)) ->
        commands--;
        flag = (master == M_SafeStop);
        if
#if !LEASE
        :: toOperatorPort ! C_Initialize, false
        :: toOperatorPort ! C_Reset, flag
#endif
        :: ARMING -> toOperatorPort ! C_Arm, false
#if EVICTS
        :: toOperatorPort ! C_Evict, false
        :: toOperatorPort ! C_EvictOther, false
        :: toOperatorPort ! C_Admit, false
#endif
        :: toOperatorPort ! C_Start, false
        :: toOperatorPort ! C_Stop, false; stopSent = true; stopDone = false
        :: toOperatorPort ! C_SafeStop, false
#if LEASE
        :: toOperatorPort ! C_TakeLease, false
        :: toOperatorPort ! C_SetSignal, false
        :: toOperatorPort ! C_Release, false
        :: toOperatorPort ! C_Ask, false
#endif
        fi }
#if LEASE
    :: atomic { !holderGone -> holderGone = true }    /* its process has died, or its connection is cut */
#endif
#endif
    od
}

inline killNode(n)
{
    closeConnection(n);
    alive[n] = false; hung[n] = false;
    node[n] = N_Disconnected;
    stranger[n] = attached[n]
}

inline killMaster()
{
    for (k : 0 .. 1) {
        linked[k] = false; attached[k] = false; halfOpen[k] = false; stranger[k] = false; stage[k] = Idle;
        flush(toMaster[k])
    };
#if EVICTS
    evicted[0] = false; evicted[1] = false;
#endif
    endCycles();                      /* tells no node: there is no connection any more */
    endStep();
    do
    :: nempty(toOperatorPort) -> toOperatorPort ? _, _
    :: empty(toOperatorPort) -> break
    od;
    master = M_Off; armed = false; culprit = 0; mustReturn = false; startAfterwards = false;
    permitted = false; latched = false;
    lease = Free; leaseAge = 0; moved = false; setting = NoValue;
    masterAlive = false; masterHung = false
}

/* Kills, hangs, cut cables, and what heals them. */
active proctype World()
{
    do
    :: atomic { faults > 0 ->
        faults--;
        if
        :: alive[0] || alive[1] ->
            if
            :: alive[0] -> who = 0
            :: alive[1] -> who = 1
            fi;
            killNode(who)
        :: runs(0) -> hung[0] = true
        :: runs(1) -> hung[1] = true
        :: linked[0] -> linked[0] = false
        :: linked[1] -> linked[1] = false
#if MASTER_FAULTS
        :: masterAlive -> killMaster()
        :: masterRuns -> masterHung = true
#endif
        fi }
    :: atomic { !alive[0] -> alive[0] = true }
    :: atomic { !alive[1] -> alive[1] = true }
    :: atomic { hung[0] -> hung[0] = false }
    :: atomic { hung[1] -> hung[1] = false }
    :: atomic { !masterAlive -> masterAlive = true }
    :: atomic { masterHung -> masterHung = false }
    od
}

/* Everything that can happen has happened, and nobody asks for more: these are the states in which a plant may rest. */
#define isAtRest(n) (attached[n] && !halfOpen[n] && linked[n] && connection[n] && alive[n] && !hung[n] && !inPhase[n] \
                     && (node[n] == N_Registered || node[n] == N_Ready || node[n] == N_Fault) \
                     && (stage[n] == Idle || stage[n] == IsInitialized) \
                     && (master != M_Ready || stage[n] != IsInitialized || node[n] != N_Registered))

active proctype Monitor()
{
    timeout ->
    assert(step == NoStep && !cycles);                                                 /* property 4 */
    assert(master == M_Off || master == M_Ready || master == M_Fault);                 /* property 4 */
    assert(both(isAtRest))                                                             /* property 4 */
}

init
{
    run Node(0);
    run Node(1)
}

#if HELPFUL
ltl moves_again { [] <> (master == M_RealTime && inCycle(0) && inCycle(1)) }
#endif
#if SINGLE_STOP
ltl stop_stops { [] ((stopSent && !stopDone) -> <> (stopDone || !masterAlive)) }
#endif
