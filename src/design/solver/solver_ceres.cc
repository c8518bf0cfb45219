/* design/solver/solver_ceres.cc - the minimiser: Ceres, kept silent, behind a C function. */
/* SPDX-License-Identifier: MIT */
extern "C" {
#include "design/solver/solver_engine.h"
}

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <cmath>
#include <cstdio>
#include <exception>
#include <memory>
#include <new>
#include <vector>

namespace
{

/* The free parameters among all, and residuals and derivatives at the point last asked for. */
class Model
{
  public:
    explicit Model(engine_run *run) : run_(run), problem_(run->problem)
    {
        all_.assign(run->parameters, run->parameters + problem_->parameter_count);
        for (size_t i = 0; i < problem_->parameter_count; i++) {
            if (run->is_free[i]) {
                places_.push_back(i);
            }
        }
        residuals.resize(problem_->residual_count);
        jacobian.resize(problem_->residual_count * problem_->parameter_count);
    }

    size_t count() const
    {
        return places_.size();
    }

    size_t place(size_t i) const
    {
        return places_[i];
    }

    const double *scatter(const double *free)
    {
        for (size_t i = 0; i < places_.size(); i++) {
            all_[places_[i]] = free[i];
        }
        return all_.data();
    }

    /* An exception must not cross the caller's C, nor his NaN Ceres. */
    bool compute(const double *free, bool derivatives)
    {
        run_->evaluations++;
        run_->derivatives += derivatives;
        good = problem_->evaluate(problem_->context, scatter(free), residuals.data(),
                                  derivatives ? jacobian.data() : nullptr) &&
               finite(residuals) && (!derivatives || finite(jacobian));
        return good;
    }

    /* Rows of the derivatives from `first` on, of the free parameters. */
    void copy(size_t first, size_t rows, double *to) const
    {
        const double *row = &jacobian[first * problem_->parameter_count];
        for (size_t i = 0; i < rows; i++, row += problem_->parameter_count) {
            for (size_t at : places_) {
                *to++ = row[at];
            }
        }
    }

    std::vector<double> residuals, jacobian;
    bool good = false;

  private:
    static bool finite(const std::vector<double> &values)
    {
        for (double value : values) {
            if (!std::isfinite(value)) {
                return false;
            }
        }
        return true;
    }

    engine_run *run_;
    const solver_problem *problem_;
    std::vector<double> all_;
    std::vector<size_t> places_;
};

/* All residuals at once. */
class Whole final : public ceres::CostFunction
{
  public:
    Whole(Model *model, size_t rows) : model_(model), rows_(rows)
    {
        set_num_residuals(static_cast<int>(rows));
        mutable_parameter_block_sizes()->push_back(static_cast<int>(model->count()));
    }

    bool Evaluate(double const *const *parameters, double *residuals,
                  double **jacobians) const override
    {
        bool derivatives = jacobians != nullptr && jacobians[0] != nullptr;
        if (!model_->compute(parameters[0], derivatives)) {
            return false;
        }
        std::copy(model_->residuals.begin(), model_->residuals.end(), residuals);
        if (derivatives) {
            model_->copy(0, rows_, jacobians[0]);
        }
        return true;
    }

  private:
    Model *model_;
    size_t rows_;
};

/* One observation: its part of what Together computed. */
class Part final : public ceres::CostFunction
{
  public:
    Part(const Model *model, size_t first, size_t rows) : model_(model), first_(first), rows_(rows)
    {
        set_num_residuals(static_cast<int>(rows));
        mutable_parameter_block_sizes()->push_back(static_cast<int>(model->count()));
    }

    bool Evaluate(double const *const *, double *residuals, double **jacobians) const override
    {
        if (!model_->good) {
            return false;
        }
        for (size_t i = 0; i < rows_; i++) {
            residuals[i] = model_->residuals[first_ + i];
        }
        if (jacobians != nullptr && jacobians[0] != nullptr) {
            model_->copy(first_, rows_, jacobians[0]);
        }
        return true;
    }

  private:
    const Model *model_;
    size_t first_, rows_;
};

/* Computes for all observations before Ceres asks each. */
class Together final : public ceres::EvaluationCallback
{
  public:
    Together(Model *model, const double *parameters) : model_(model), parameters_(parameters)
    {
    }

    void PrepareForEvaluation(bool derivatives, bool new_point) override
    {
        if (new_point || derivatives) {
            model_->compute(parameters_, derivatives);
        }
    }

  private:
    Model *model_;
    const double *parameters_;
};

class Watch final : public ceres::IterationCallback
{
  public:
    Watch(engine_run *run, Model *model, const double *parameters)
        : run_(run), model_(model), parameters_(parameters)
    {
    }

    ceres::CallbackReturnType operator()(const ceres::IterationSummary &summary) override
    {
        /* of a step that was taken back it tells the cost there */
        cost_ = summary.step_is_successful ? summary.cost : cost_;
        bool on = run_->watch(run_->watch_context, summary.iteration, cost_,
                              model_->scatter(parameters_));
        return on ? ceres::SOLVER_CONTINUE : ceres::SOLVER_TERMINATE_SUCCESSFULLY;
    }

  private:
    engine_run *run_;
    Model *model_;
    const double *parameters_;
    double cost_ = 0;
};

ceres::LossFunction *loss_of(const solver_block &block)
{
    switch (block.loss) {
    case LOSS_HUBER:
        return new ceres::HuberLoss(block.scale);
    case LOSS_SOFT_L1:
        return new ceres::SoftLOneLoss(block.scale);
    case LOSS_CAUCHY:
        return new ceres::CauchyLoss(block.scale);
    case LOSS_NONE:
        break;
    }
    return nullptr;
}

void add_residuals(const solver_problem *from, Model *model, double *parameters,
                   ceres::Problem *problem)
{
    if (from->blocks == nullptr) {
        problem->AddResidualBlock(new Whole(model, from->residual_count), nullptr, parameters);
        return;
    }
    size_t first = 0;
    for (size_t i = 0; i < from->block_count; i++) {
        const solver_block &block = from->blocks[i];
        if (block.residuals > 0) {
            problem->AddResidualBlock(new Part(model, first, block.residuals), loss_of(block),
                                      parameters);
        }
        first += block.residuals;
    }
}

void add_bounds(const solver_problem *from, const Model &model, double *parameters,
                ceres::Problem *problem)
{
    for (size_t i = 0; i < model.count(); i++) {
        double low = from->low != nullptr ? from->low[model.place(i)] : -INFINITY;
        double high = from->high != nullptr ? from->high[model.place(i)] : INFINITY;
        if (std::isfinite(low)) {
            problem->SetParameterLowerBound(parameters, static_cast<int>(i), low);
        }
        if (std::isfinite(high)) {
            problem->SetParameterUpperBound(parameters, static_cast<int>(i), high);
        }
    }
}

ceres::Solver::Options options_of(const solver_options &from)
{
    ceres::Solver::Options options;
    options.minimizer_type = ceres::TRUST_REGION;
    options.trust_region_strategy_type = ceres::LEVENBERG_MARQUARDT;
    options.linear_solver_type = ceres::DENSE_QR;
    options.max_num_iterations = from.iterations;
    options.function_tolerance = from.function;
    options.gradient_tolerance = from.gradient;
    options.parameter_tolerance = from.parameter;
    options.initial_trust_region_radius = from.initial_trust;
    options.max_num_consecutive_invalid_steps = 20;
    options.num_threads = 1;
    options.logging_type = ceres::SILENT;
    options.minimizer_progress_to_stdout = false;
    options.update_state_every_iteration = true;
    return options;
}

engine_end end_of(ceres::TerminationType type)
{
    switch (type) {
    case ceres::CONVERGENCE:
        return ENGINE_CONVERGED;
    case ceres::NO_CONVERGENCE:
        return ENGINE_LIMIT;
    case ceres::USER_SUCCESS:
        return ENGINE_WATCHED;
    default:
        return ENGINE_FAILED;
    }
}

void minimize(engine_run *run)
{
    Model model(run);
    std::vector<double> parameters;
    for (size_t i = 0; i < model.count(); i++) {
        parameters.push_back(run->parameters[model.place(i)]);
    }
    Together together(&model, parameters.data());
    Watch watch(run, &model, parameters.data());
    ceres::Problem::Options ways;
    ways.evaluation_callback = run->problem->blocks != nullptr ? &together : nullptr;
    ceres::Problem problem(ways);
    problem.AddParameterBlock(parameters.data(), static_cast<int>(parameters.size()));
    add_residuals(run->problem, &model, parameters.data(), &problem);
    add_bounds(run->problem, model, parameters.data(), &problem);
    ceres::Solver::Options options = options_of(run->options);
    options.callbacks.push_back(&watch);
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    run->end = end_of(summary.termination_type);
    run->iterations = static_cast<int>(summary.iterations.size());
    run->iterations -= run->iterations > 0;
    snprintf(run->message, sizeof run->message, "%s", summary.message.c_str());
    const double *best = model.scatter(parameters.data());
    std::copy(best, best + run->problem->parameter_count, run->parameters);
}

} // namespace

extern "C" void ceres_minimize(engine_run *run)
{
    /* nothing of its log reaches standard error */
    FLAGS_minloglevel = google::GLOG_FATAL;
    /* an exception on its way through what runs threads would abort */
    std::set_new_handler(arena_end);
    try {
        minimize(run);
    } catch (const std::bad_alloc &) {
        run->end = ENGINE_NO_MEMORY;
    } catch (const std::exception &trouble) {
        run->end = ENGINE_FAILED;
        snprintf(run->message, sizeof run->message, "%s", trouble.what());
    } catch (...) {
        run->end = ENGINE_FAILED;
        snprintf(run->message, sizeof run->message, "an unknown exception");
    }
}
