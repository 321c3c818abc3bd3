/* SPDX-License-Identifier: Apache-2.0 */
#ifndef RTW_HEADER_Pendulum_types_h_
#define RTW_HEADER_Pendulum_types_h_

/* Parameters (default storage) */
typedef struct P_Pendulum_T_ P_Pendulum_T;

/* Forward declaration for rtModel */
typedef struct tag_RTM_Pendulum_T RT_MODEL_Pendulum_T;

#endif
