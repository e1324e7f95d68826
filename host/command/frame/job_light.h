/* The lighting step of a job. */
#ifndef TL_JOB_LIGHT_H
#define TL_JOB_LIGHT_H

#include "explain.h"
#include "goal.h"
#include "job.h"
#include "lighter.h"
#include "lighting_options.h"

/* Reads a lights file, as the choice scales and switches them; path NULL: does nothing. */
tl_status job_take_lights(job *j,
                          const lighting_choice *choice,
                          const char *path,
                          tl_error *err);

/* Opens the device that the choice needs. *device stays NULL for a precision without one; release with
 * tl_device_close. */
tl_status job_open_device(job *j,
                          const lighting_choice *choice,
                          tl_device **device,
                          tl_error *err);

/* Both, with the lights file that the choice has: what can be refused before a scene is loaded. */
tl_status job_prepare_light(job *j,
                            const lighting_choice *choice,
                            tl_device **device,
                            tl_error *err);

/* Adds a default rig, and says so, where neither a file nor the G-buffer brought lights. */
tl_status job_default_lights(job *j, tl_error *err);

/* The same, where no sky that was chosen lights the scene either; the job's sky becomes that one. Fails as
 * sky_choose does too. */
tl_status job_choose_lights(job *j, const sky_choice *sky, tl_error *err);

/* Scales lights, and switches them off, that job_prepare_light has not read: those of a frame, or that stand
 * in for them. Fails as tl_light_set_control does. */
tl_status job_control_lights(job *j, const lighting_choice *choice, tl_error *err);

/* Makes the lights those that the choice asks for, with sky, rig and radius, once: job_light does where nobody did
 * before. Needs no device. Fails as job_choose_lights and job_control_lights do. */
tl_status job_ready_lights(job *j, const lighting_choice *choice, tl_error *err);

/* Makes lights that were given what frames are lit by, with the sky and the radius of the choice: for
 * job_lend_lights. Fails as sky_choose. */
tl_status job_settle_lights(job *j, const lighting_choice *choice, tl_error *err);

/* The lights of `from`, which were settled and which it keeps as long as `to` needs them. */
void job_lend_lights(const job *from, job *to);

/* The radius of ambient occlusion that was chosen, in place of the lights' own. */
void job_choose_occlusion(job *j, const lighting_choice *choice);

/* From the job's G-buffer and lights to its image. Without lights, a default rig lights it. `goal` is what
 * the picture is to keep; NULL: it is lit as the choice says. `told` is
 * what --explain tells of, released with explained_clear; NULL where nothing asks for it. What the lighter keeps
 * is of this choice from then on. */
tl_status job_light(job *j,
                    const lighting_choice *choice,
                    const tl_goal *goal,
                    lighter *with,
                    explained *told,
                    tl_error *err);

#endif
